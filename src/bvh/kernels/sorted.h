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

/// Writes the children met, farthest first. There must be room for eight.
inline void push_sorted(const Node& node, Bits met, F8 enter, std::uint32_t* child, float* at) {
    const __m256i lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
    const __m256i bit = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
    const __m256i is_met =
        _mm256_cmpeq_epi32(_mm256_and_si256(_mm256_set1_epi32(static_cast<int>(met)), bit), bit);
    const __m256i distance =
        _mm256_andnot_si256(_mm256_set1_epi32(7), _mm256_castps_si256(enter.v));
    const __m256i sorted =
        sort_descending(_mm256_and_si256(_mm256_or_si256(distance, lane), is_met));
    const __m256i children = _mm256_load_si256(reinterpret_cast<const __m256i*>(node.child));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(child),
                        _mm256_permutevar8x32_epi32(children, sorted)); // takes the last three bits
    _mm256_storeu_ps(at, _mm256_castsi256_ps(_mm256_andnot_si256(_mm256_set1_epi32(7), sorted)));
}

#else

inline void push_sorted(const Node& node, Bits met, F8 enter, std::uint32_t* child, float* at) {
    alignas(64) float distance[width];
    enter.store(distance);
    for (unsigned count = 0; met; met &= met - 1, ++count) {
        const unsigned c = lowest(met);
        unsigned place = count;
        for (; place > 0 && at[place - 1] < distance[c]; --place) {
            at[place] = at[place - 1];
            child[place] = child[place - 1];
        }
        at[place] = distance[c];
        child[place] = node.child[c];
    }
}

#endif

} // namespace hemilux::wide::HEMILUX_KERNELS
