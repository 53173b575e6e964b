// A stack of what a ray has still to visit. The children that it meets are pushed in an order that
// was fixed when the tree was built, one for each octant of directions (after Ylitie, Karras and
// Laine 2017). That needs no sorting and no branch on how many they are. No #pragma once: see
// simd.h.

namespace hemilux::wide::HEMILUX_KERNELS {

/// Returns the octant that a direction belongs to, from the signs of its components.
inline unsigned octant_of(const float* direction) {
    return unsigned{direction[0] < 0} | unsigned{direction[1] < 0} << 1 |
           unsigned{direction[2] < 0} << 2;
}

#if defined(__AVX2__)

/// A permutation that brings eight words of 32 bits into a node's order and stores those in a mask
/// without gaps. Words behind them are overwritten too.
struct Ordering {
    __m256i place;
    unsigned met;

    /// Takes the lanes with low <= high.
    Ordering(const Node& node, unsigned octant, F8 low, F8 high) {
        place = _mm256_srlv_epi32(_mm256_set1_epi32(static_cast<int>(node.order[octant])),
                                  _mm256_setr_epi32(0, 4, 8, 12, 16, 20, 24, 28));
        const F8 from{_mm256_permutevar8x32_ps(low.v, place)};
        const F8 to{_mm256_permutevar8x32_ps(high.v, place)};
#if defined(__AVX512VL__)
        met = _mm256_cmp_ps_mask(from.v, to.v, _CMP_LE_OQ); // stays in a mask register
#else
        met = less_equal(from, to);
        place = _mm256_permutevar8x32_epi32(place, gaps_closed(met));
#endif
    }
    [[nodiscard]] unsigned count() const { return static_cast<unsigned>(__builtin_popcount(met)); }
    void store(const std::uint32_t* words, std::uint32_t* to) const {
        write(_mm256_load_si256(reinterpret_cast<const __m256i*>(words)), to);
    }
    void store(F8 words, float* to) const { write(_mm256_castps_si256(words.v), to); }

  private:
    void write(__m256i words, void* to) const {
        __m256i ordered = _mm256_permutevar8x32_epi32(words, place);
#if defined(__AVX512VL__)
        ordered = _mm256_maskz_compress_epi32(static_cast<__mmask8>(met), ordered);
#endif
        _mm256_storeu_si256(static_cast<__m256i*>(to), ordered);
    }
#if !defined(__AVX512VL__)
    /// Returns the lanes in the mask, then anything.
    static __m256i gaps_closed(unsigned mask) {
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
        return _mm256_cvtepu8_epi32(
            _mm_loadl_epi64(reinterpret_cast<const __m128i*>(table.lane[mask])));
    }
#endif
};

#else

struct Ordering {
    unsigned char lane[width];
    unsigned number = 0;

    Ordering(const Node& node, unsigned octant, F8 low, F8 high) {
        const Bits met = less_equal(low, high);
        std::uint32_t order = node.order[octant];
        for (unsigned k = 0; k < width; ++k, order >>= 4) {
            lane[number] = order & 7;
            number += met >> (order & 7) & 1;
        }
    }
    [[nodiscard]] unsigned count() const { return number; }
    void store(const std::uint32_t* words, std::uint32_t* to) const {
        for (unsigned k = 0; k < number; ++k)
            to[k] = words[lane[k]];
    }
    void store(F8 words, float* to) const {
        alignas(64) float word[width];
        words.store(word);
        for (unsigned k = 0; k < number; ++k)
            to[k] = word[lane[k]];
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
    alignas(64) std::uint32_t child[room * at_once];
    alignas(64) float enter[room * at_once]; ///< places where rays are stopped

    void clear() {
        child[0] = no_facet;
        enter[0] = -__builtin_inff();
        top = 1;
    }
    template <Rays rays>
    void push(const Node& node, unsigned octant, F8 from, F8 to) {
        const Ordering ordering(node, octant, from, to);
        const unsigned t = top;
        ordering.store(node.child, child + t);
        if constexpr (rays == Rays::stop)
            ordering.store(from, enter + t);
        top = t + ordering.count();
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
