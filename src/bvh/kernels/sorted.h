// The children that a ray meets, in order of distance, without a branch on how many they are: a
// network sorts eight keys, each the distance with the lane in its last three bits (so that a
// distance is taken a little too small, which loses nothing). No #pragma once: see simd.h.

namespace hemilux::wide::HEMILUX_KERNELS {

#if defined(__AVX2__)

/// One step: lanes are compared with those of `other`; lanes in `keep_max` keep the larger.
template <int keep_max>
inline __m256i exchange(__m256i key, __m256i other) {
    return _mm256_blend_epi32(_mm256_min_epu32(key, other), _mm256_max_epu32(key, other), keep_max);
}

/// Largest first (Batcher's bitonic network).
inline __m256i sort_descending(__m256i k) {
    k = exchange<0b01010101>(k, _mm256_shuffle_epi32(k, _MM_SHUFFLE(2, 3, 0, 1)));
    k = exchange<0b00110011>(k, _mm256_shuffle_epi32(k, _MM_SHUFFLE(0, 1, 2, 3)));
    k = exchange<0b01010101>(k, _mm256_shuffle_epi32(k, _MM_SHUFFLE(2, 3, 0, 1)));
    k = exchange<0b00001111>(
        k, _mm256_permutevar8x32_epi32(k, _mm256_setr_epi32(7, 6, 5, 4, 3, 2, 1, 0)));
    k = exchange<0b00110011>(k, _mm256_shuffle_epi32(k, _MM_SHUFFLE(1, 0, 3, 2)));
    return exchange<0b01010101>(k, _mm256_shuffle_epi32(k, _MM_SHUFFLE(2, 3, 0, 1)));
}

/// Writes the names and distances of the lanes with low <= high, the farthest first, and returns
/// how many. There must be room for eight.
inline unsigned push_sorted(const std::uint32_t* names, F8 distances, F8 low, F8 high,
                            std::uint32_t* name, float* distance) {
    const __m256i lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
    const __m256i cut = _mm256_andnot_si256(_mm256_set1_epi32(7), _mm256_castps_si256(distances.v));
#if defined(__AVX512VL__)
    const __mmask8 met = _mm256_cmp_ps_mask(low.v, high.v, _CMP_LE_OQ);
    const __m256i key = _mm256_maskz_or_epi32(met, cut, lane);
#else
    const __m256 is_met = _mm256_cmp_ps(low.v, high.v, _CMP_LE_OQ);
    const auto met = static_cast<Bits>(_mm256_movemask_ps(is_met));
    const __m256i key = _mm256_and_si256(_mm256_or_si256(cut, lane), _mm256_castps_si256(is_met));
#endif
    const __m256i sorted = sort_descending(key);
    const __m256i given = _mm256_load_si256(reinterpret_cast<const __m256i*>(names));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(name),
                        _mm256_permutevar8x32_epi32(given, sorted)); // takes the last three bits
    _mm256_storeu_ps(distance,
                     _mm256_castsi256_ps(_mm256_andnot_si256(_mm256_set1_epi32(7), sorted)));
    return static_cast<unsigned>(__builtin_popcount(met));
}

#else

inline unsigned push_sorted(const std::uint32_t* names, F8 distances, F8 low, F8 high,
                            std::uint32_t* name, float* distance) {
    alignas(64) float at[width];
    distances.store(at);
    unsigned count = 0;
    for (Bits met = less_equal(low, high); met; met &= met - 1, ++count) {
        const unsigned c = first_of(met);
        unsigned place = count;
        for (; place > 0 && distance[place - 1] < at[c]; --place) {
            distance[place] = distance[place - 1];
            name[place] = name[place - 1];
        }
        distance[place] = at[c];
        name[place] = names[c];
    }
    return count;
}

#endif

/// The same in any order, where the order does not matter; distances are not written.
inline unsigned push_unsorted(const std::uint32_t* names, F8 low, F8 high, std::uint32_t* name) {
    Bits met = less_equal(low, high);
#if defined(__AVX512VL__)
    _mm256_storeu_si256(
        reinterpret_cast<__m256i*>(name),
        _mm256_maskz_compress_epi32(static_cast<__mmask8>(met),
                                    _mm256_load_si256(reinterpret_cast<const __m256i*>(names))));
    return static_cast<unsigned>(__builtin_popcount(met));
#else
    unsigned count = 0;
    for (; met; met &= met - 1)
        name[count++] = names[first_of(met)];
    return count;
#endif
}

/// Whether rays are stopped by what they hit, or pierce everything: then no order is kept.
enum class Rays { stop, pierce };

/// What remains to be visited, the nearest on top. At the bottom lies an entry that says so.
struct Stack {
    std::uint32_t child[stack_size + width + 1];
    float enter[stack_size + width + 1];
    unsigned top;

    void clear() {
        child[0] = no_facet;
        enter[0] = -__builtin_inff();
        top = 1;
    }
    void push_one(std::uint32_t c, float at) {
        child[top] = c;
        enter[top++] = at;
    }
    template <Rays rays>
    void push(const Node& node, F8 from, F8 to) {
        if constexpr (rays == Rays::stop)
            top += push_sorted(node.child, from, from, to, child + top, enter + top);
        else
            top += push_unsorted(node.child, from, to, child + top);
    }
    /// Takes the topmost entry that lies before `limit`; false: there is none.
    template <Rays rays>
    bool pop(float limit, std::uint32_t& next) {
        if constexpr (rays == Rays::pierce) {
            next = child[--top];
            return next != no_facet;
        }
        unsigned t = top - 1;
        t -= enter[t] > limit; // how many there are is hard to foresee for the processor
        t -= enter[t] > limit;
        while (enter[t] > limit)
            --t;
        next = child[t];
        top = t;
        return next != no_facet;
    }
};

} // namespace hemilux::wide::HEMILUX_KERNELS
