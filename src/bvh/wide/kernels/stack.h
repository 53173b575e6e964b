// A stack of what a ray has still to visit. Where a hit stops the ray, the children that it meets
// are pushed in an order that was fixed when the tree was built, one for each octant of directions
// (after Ylitie, Karras and Laine 2017). That needs no sorting and no branch on how many they are.
// No #pragma once: see simd.h.

namespace hemilux::wide::HEMILUX_KERNELS {

#if defined(__AVX2__)

/// Stores words of 32 bits without gaps: the lanes in a mask, then anything.
struct Packing {
    unsigned met;
#if defined(__AVX512VL__)
    explicit Packing(Lanes lanes) : met(lanes.m) {}
    void store(__m256i words, void* to) const {
        _mm256_storeu_si256(static_cast<__m256i*>(to),
                            _mm256_maskz_compress_epi32(static_cast<__mmask8>(met), words));
    }
#else
    __m256i place;

    explicit Packing(Lanes lanes) : met(bits(lanes)) {
        struct Table {
            unsigned char lane[256][8] = {};
            constexpr Table() {
                for (unsigned m = 0; m < 256; ++m)
                    for (unsigned bit = 0, count = 0; bit < 8; ++bit)
                        if (m >> bit & 1)
                            lane[m][count++] = static_cast<unsigned char>(bit);
            }
        };
        alignas(64) static constexpr Table table;
        place = _mm256_cvtepu8_epi32(
            _mm_loadl_epi64(reinterpret_cast<const __m128i*>(table.lane[met])));
    }
    void store(__m256i words, void* to) const {
        _mm256_storeu_si256(static_cast<__m256i*>(to), _mm256_permutevar8x32_epi32(words, place));
    }
#endif
    [[nodiscard]] unsigned count() const { return static_cast<unsigned>(__builtin_popcount(met)); }
};

/// The children of a node, with where a ray enters their boxes and leaves them.
struct Children {
    __m256i child;
    F8 enter, leave;

    Children(const Node& node, F8 enter_, F8 leave_)
        : child(_mm256_load_si256(reinterpret_cast<const __m256i*>(node.child))), enter(enter_),
          leave(leave_) {}

    /// Brings them into the node's order for an octant.
    void order(const Node& node, unsigned octant) {
        const __m256i place =
            _mm256_srlv_epi32(_mm256_set1_epi32(static_cast<int>(node.order[octant])),
                              _mm256_setr_epi32(0, 4, 8, 12, 16, 20, 24, 28));
        child = _mm256_permutevar8x32_epi32(child, place);
        enter.v = _mm256_permutevar8x32_ps(enter.v, place);
        leave.v = _mm256_permutevar8x32_ps(leave.v, place);
    }
    /// Stores those that are met, and where they are entered if that is asked for. Returns how many
    /// they are.
    unsigned store_met(std::uint32_t* children, float* enters) const {
        const Packing packing(less_equal(enter, leave));
        packing.store(child, children);
        if (enters)
            packing.store(_mm256_castps_si256(enter.v), enters);
        return packing.count();
    }
};

#else

/// The children of a node, with where a ray enters their boxes.
struct Children {
    const std::uint32_t* child;
    alignas(64) float enter[width];
    Bits met;
    std::uint32_t places = 0x76543210;

    Children(const Node& node, F8 enter_, F8 leave)
        : child(node.child), met(bits(less_equal(enter_, leave))) {
        enter_.store(enter);
    }
    void order(const Node& node, unsigned octant) { places = node.order[octant]; }
    unsigned store_met(std::uint32_t* children, float* enters) const {
        unsigned number = 0;
        for (std::uint32_t left = places, k = 0; k < width; ++k, left >>= 4) {
            const unsigned lane = left & 7;
            children[number] = child[lane];
            if (enters)
                enters[number] = enter[lane];
            number += met >> lane & 1;
        }
        return number;
    }
};

#endif

/// This says whether rays are stopped by what they hit, or pierce everything up to an end that is
/// known.
enum class Rays { stop, pierce };

/// The nodes and leaves that remain to be visited, the nearest on top. At the bottom lies an entry
/// that says so.
struct Stack {
    static constexpr unsigned at_once = 16; ///< entries that are compared together
    static constexpr unsigned room = (stack_size + width) / at_once + 1;

    unsigned top;
    std::uint32_t child[room * at_once];
    alignas(64) float enter[room * at_once]; ///< kept where rays are stopped

    void clear() {
        child[0] = no_facet;
        enter[0] = -__builtin_inff();
        top = 1;
    }
    /// Pushes the children that are met: where rays are stopped, in an order that was fixed for
    /// each octant of directions; else in that of the node, whose last child is the largest.
    template <Rays rays>
    void push(const Node& node, unsigned octant, F8 from, F8 to) {
        Children children(node, from, to);
        if constexpr (rays == Rays::stop)
            children.order(node, octant);
        top += children.store_met(child + top, rays == Rays::stop ? enter + top : nullptr);
    }
    /// Returns the topmost entry; no_facet: there is none.
    std::uint32_t pop() { return child[--top]; }
    /// Does the same after the ray was perhaps stopped: entries behind `limit` are passed over. One
    /// that lies below others may stay; its children are not met then. No branch depends on how
    /// many they are, which the processor could not foresee.
    template <Rays rays>
    std::uint32_t pop_before(float limit) {
        if constexpr (rays == Rays::pierce)
            return pop();
        unsigned first = (top - 1) / at_once * at_once;
        Bits before = at_most(enter + first, limit) & ((Bits{1} << (top - first)) - 1);
        for (; before == 0; before = at_most(enter + first, limit))
            first -= at_once;
        top = first + last_of(before);
        return child[top];
    }
};

} // namespace hemilux::wide::HEMILUX_KERNELS
