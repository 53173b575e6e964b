// Eight and sixteen floats at once, in whatever pieces the instruction set has: vectors of the
// compiler, and intrinsics only for what those cannot say (minimum, comparison to bits). A
// comparison gives bits, lane i in bit i, in every instruction set. No #pragma once: included once
// per instruction set, into a namespace of its own.

#include <cstdint>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace hemilux::wide::HEMILUX_KERNELS {

using Bits = std::uint32_t;

inline unsigned first_of(Bits bits) { return static_cast<unsigned>(__builtin_ctz(bits)); }
inline unsigned last_of(Bits bits) { return 31 - static_cast<unsigned>(__builtin_clz(bits)); }
inline unsigned count_bits(Bits bits) { return static_cast<unsigned>(__builtin_popcount(bits)); }

/// Four lanes: what every compiler has.
struct F4 {
    typedef float Vector __attribute__((vector_size(16)));
    static constexpr unsigned lanes = 4;
    Vector v;

    static F4 splat(float x) { return {Vector{x, x, x, x}}; }
    static F4 load(const float* p) { return {*reinterpret_cast<const Vector*>(p)}; }
    void store(float* p) const { *reinterpret_cast<Vector*>(p) = v; }
    friend F4 operator+(F4 a, F4 b) { return {a.v + b.v}; }
    friend F4 operator-(F4 a, F4 b) { return {a.v - b.v}; }
    friend F4 operator*(F4 a, F4 b) { return {a.v * b.v}; }
    friend F4 operator/(F4 a, F4 b) { return {a.v / b.v}; }
#if defined(__SSE2__)
    friend F4 min(F4 a, F4 b) { return {_mm_min_ps(a.v, b.v)}; }
    friend F4 max(F4 a, F4 b) { return {_mm_max_ps(a.v, b.v)}; }
    friend Bits less_equal(F4 a, F4 b) {
        return static_cast<Bits>(_mm_movemask_ps(_mm_cmple_ps(a.v, b.v)));
    }
    friend Bits less(F4 a, F4 b) {
        return static_cast<Bits>(_mm_movemask_ps(_mm_cmplt_ps(a.v, b.v)));
    }
#else
    friend F4 min(F4 a, F4 b) { return {a.v < b.v ? a.v : b.v}; }
    friend F4 max(F4 a, F4 b) { return {a.v > b.v ? a.v : b.v}; }
    friend Bits less_equal(F4 a, F4 b) { return to_bits(a.v <= b.v); }
    friend Bits less(F4 a, F4 b) { return to_bits(a.v < b.v); }
    template <class Mask>
    static Bits to_bits(Mask m) {
        return static_cast<Bits>((m[0] & 1) | (m[1] & 2) | (m[2] & 4) | (m[3] & 8));
    }
#endif
    friend F4 abs(F4 a) { return max(a, F4{-a.v}); }
    friend float lowest(F4 a) {
        const float x = a.v[0] < a.v[1] ? a.v[0] : a.v[1], y = a.v[2] < a.v[3] ? a.v[2] : a.v[3];
        return x < y ? x : y;
    }
    friend F4 select(Bits bits, F4 a, F4 b) {
        return {Vector{bits & 1 ? a.v[0] : b.v[0], bits & 2 ? a.v[1] : b.v[1],
                       bits & 4 ? a.v[2] : b.v[2], bits & 8 ? a.v[3] : b.v[3]}};
    }
};

/// Two halves side by side.
template <class Half>
struct Pair {
    static constexpr unsigned lanes = 2 * Half::lanes;
    Half a, b;

    static Pair splat(float x) { return {Half::splat(x), Half::splat(x)}; }
    static Pair load(const float* p) { return {Half::load(p), Half::load(p + Half::lanes)}; }
    void store(float* p) const {
        a.store(p);
        b.store(p + Half::lanes);
    }
    friend Pair operator+(Pair x, Pair y) { return {x.a + y.a, x.b + y.b}; }
    friend Pair operator-(Pair x, Pair y) { return {x.a - y.a, x.b - y.b}; }
    friend Pair operator*(Pair x, Pair y) { return {x.a * y.a, x.b * y.b}; }
    friend Pair operator/(Pair x, Pair y) { return {x.a / y.a, x.b / y.b}; }
    friend Pair min(Pair x, Pair y) { return {min(x.a, y.a), min(x.b, y.b)}; }
    friend Pair max(Pair x, Pair y) { return {max(x.a, y.a), max(x.b, y.b)}; }
    friend Pair abs(Pair x) { return {abs(x.a), abs(x.b)}; }
    friend Bits less_equal(Pair x, Pair y) {
        return less_equal(x.a, y.a) | less_equal(x.b, y.b) << Half::lanes;
    }
    friend float lowest(Pair x) { return lowest(min(x.a, x.b)); }
    friend Pair select(Bits bits, Pair x, Pair y) {
        return {select(bits, x.a, y.a), select(bits >> Half::lanes, x.b, y.b)};
    }
    friend Bits less(Pair x, Pair y) { return less(x.a, y.a) | less(x.b, y.b) << Half::lanes; }
};

#if defined(__AVX2__)
struct F8 {
    static constexpr unsigned lanes = 8;
    __m256 v;

    static F8 splat(float x) { return {_mm256_set1_ps(x)}; }
    static F8 load(const float* p) { return {_mm256_load_ps(p)}; }
    void store(float* p) const { _mm256_store_ps(p, v); }
    friend F8 operator+(F8 a, F8 b) { return {a.v + b.v}; }
    friend F8 operator-(F8 a, F8 b) { return {a.v - b.v}; }
    friend F8 operator*(F8 a, F8 b) { return {a.v * b.v}; }
    friend F8 operator/(F8 a, F8 b) { return {a.v / b.v}; }
    friend F8 min(F8 a, F8 b) { return {_mm256_min_ps(a.v, b.v)}; }
    friend F8 max(F8 a, F8 b) { return {_mm256_max_ps(a.v, b.v)}; }
    friend float lowest(F8 a) {
        const __m128 four = _mm_min_ps(_mm256_castps256_ps128(a.v), _mm256_extractf128_ps(a.v, 1));
        return lowest(F4{four});
    }
    friend F8 select(Bits bits, F8 a, F8 b) {
        const __m256i bit = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
        const __m256i mask = _mm256_cmpeq_epi32(
            _mm256_and_si256(_mm256_set1_epi32(static_cast<int>(bits)), bit), bit);
        return {_mm256_blendv_ps(b.v, a.v, _mm256_castsi256_ps(mask))};
    }
    friend F8 abs(F8 a) { return {_mm256_andnot_ps(_mm256_set1_ps(-0.0f), a.v)}; }
    friend Bits less_equal(F8 a, F8 b) {
        return static_cast<Bits>(_mm256_movemask_ps(_mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ)));
    }
    friend Bits less(F8 a, F8 b) {
        return static_cast<Bits>(_mm256_movemask_ps(_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ)));
    }
};
#else
using F8 = Pair<F4>;
#endif

/// Which of eight words, but for the bits of `ignored`, are `word`.
inline Bits equal(const std::uint32_t* words, std::uint32_t ignored, std::uint32_t word) {
#if defined(__AVX2__)
    const __m256i eight = _mm256_load_si256(reinterpret_cast<const __m256i*>(words));
    const __m256i same =
        _mm256_cmpeq_epi32(_mm256_andnot_si256(_mm256_set1_epi32(static_cast<int>(ignored)), eight),
                           _mm256_set1_epi32(static_cast<int>(word)));
    return static_cast<Bits>(_mm256_movemask_ps(_mm256_castsi256_ps(same)));
#else
    Bits bits = 0;
    for (unsigned k = 0; k < 8; ++k)
        bits |= Bits{(words[k] & ~ignored) == word} << k;
    return bits;
#endif
}

#if defined(__AVX512F__) && defined(__AVX512DQ__)
struct F16 {
    static constexpr unsigned lanes = 16;
    __m512 v;

    static F16 splat(float x) { return {_mm512_set1_ps(x)}; }
    static F16 load(const float* p) { return {_mm512_load_ps(p)}; }
    void store(float* p) const { _mm512_store_ps(p, v); }
    friend F16 operator+(F16 a, F16 b) { return {a.v + b.v}; }
    friend F16 operator-(F16 a, F16 b) { return {a.v - b.v}; }
    friend F16 operator*(F16 a, F16 b) { return {a.v * b.v}; }
    friend F16 operator/(F16 a, F16 b) { return {a.v / b.v}; }
    friend F16 min(F16 a, F16 b) { return {_mm512_min_ps(a.v, b.v)}; }
    friend F16 max(F16 a, F16 b) { return {_mm512_max_ps(a.v, b.v)}; }
    friend float lowest(F16 a) {
        return lowest(min(F8{_mm512_castps512_ps256(a.v)}, F8{_mm512_extractf32x8_ps(a.v, 1)}));
    }
    friend F16 select(Bits bits, F16 a, F16 b) {
        return {_mm512_mask_blend_ps(static_cast<__mmask16>(bits), b.v, a.v)};
    }
    friend F16 abs(F16 a) { return {_mm512_abs_ps(a.v)}; }
    friend Bits less_equal(F16 a, F16 b) { return _mm512_cmp_ps_mask(a.v, b.v, _CMP_LE_OQ); }
    friend Bits less(F16 a, F16 b) { return _mm512_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ); }
};
#else
using F16 = Pair<F8>;
#endif

} // namespace hemilux::wide::HEMILUX_KERNELS
