// Eight floats at once, in whatever pieces the instruction set has. The code uses the compiler's
// vectors, and intrinsics only for what those cannot say (minimum, comparison). A comparison gives
// lanes, in the form that the instruction set has for them; bits(lanes) has lane i in bit i. There
// is no #pragma once, as the file is included once per instruction set, into a namespace of its
// own.

#include <cstdint>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace hemilux::wide::HEMILUX_KERNELS {

using Bits = std::uint32_t;

inline unsigned first_of(Bits bits) { return static_cast<unsigned>(__builtin_ctz(bits)); }
inline unsigned last_of(Bits bits) { return 31 - static_cast<unsigned>(__builtin_clz(bits)); }
inline unsigned count_bits(Bits bits) { return static_cast<unsigned>(__builtin_popcount(bits)); }

/// A set of the eight lanes.
#if defined(__AVX512VL__)
struct Lanes {
    __mmask8 m;

    friend Lanes operator&(Lanes a, Lanes b) { return {_kand_mask8(a.m, b.m)}; }
    friend Lanes operator|(Lanes a, Lanes b) { return {_kor_mask8(a.m, b.m)}; }
    friend Lanes without(Lanes a, Lanes b) { return {_kandn_mask8(b.m, a.m)}; }
    friend Bits bits(Lanes a) { return _cvtmask8_u32(a.m); }
};
#elif defined(__AVX2__)
struct Lanes {
    __m256 v; ///< all bits of a lane are equal

    friend Lanes operator&(Lanes a, Lanes b) { return {_mm256_and_ps(a.v, b.v)}; }
    friend Lanes operator|(Lanes a, Lanes b) { return {_mm256_or_ps(a.v, b.v)}; }
    friend Lanes without(Lanes a, Lanes b) { return {_mm256_andnot_ps(b.v, a.v)}; }
    friend Bits bits(Lanes a) { return static_cast<Bits>(_mm256_movemask_ps(a.v)); }
};
#else
struct Lanes {
    Bits b;

    friend Lanes operator&(Lanes x, Lanes y) { return {x.b & y.b}; }
    friend Lanes operator|(Lanes x, Lanes y) { return {x.b | y.b}; }
    friend Lanes without(Lanes x, Lanes y) { return {x.b & ~y.b}; }
    friend Bits bits(Lanes x) { return x.b; }
};
#endif

#if defined(__AVX2__)
struct F8 {
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
    friend F8 abs(F8 a) { return {_mm256_andnot_ps(_mm256_set1_ps(-0.0f), a.v)}; }
    /// Returns a, with its sign changed where that of b is set.
    friend F8 flip(F8 a, F8 b) {
        return {_mm256_xor_ps(a.v, _mm256_and_ps(_mm256_set1_ps(-0.0f), b.v))};
    }
#if defined(__AVX512VL__)
    friend Lanes less_equal(F8 a, F8 b) { return {_mm256_cmp_ps_mask(a.v, b.v, _CMP_LE_OQ)}; }
    friend Lanes less(F8 a, F8 b) { return {_mm256_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ)}; }
#else
    friend Lanes less_equal(F8 a, F8 b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ)}; }
    friend Lanes less(F8 a, F8 b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ)}; }
#endif
};
#else
/// Four lanes: what every compiler has.
struct F4 {
    typedef float Vector __attribute__((vector_size(16)));
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
    friend F4 flip(F4 a, F4 b) { return {b.v < 0 ? -a.v : a.v}; }
};

/// Two halves side by side.
struct F8 {
    F4 a, b;

    static F8 splat(float x) { return {F4::splat(x), F4::splat(x)}; }
    static F8 load(const float* p) { return {F4::load(p), F4::load(p + 4)}; }
    void store(float* p) const {
        a.store(p);
        b.store(p + 4);
    }
    friend F8 operator+(F8 x, F8 y) { return {x.a + y.a, x.b + y.b}; }
    friend F8 operator-(F8 x, F8 y) { return {x.a - y.a, x.b - y.b}; }
    friend F8 operator*(F8 x, F8 y) { return {x.a * y.a, x.b * y.b}; }
    friend F8 operator/(F8 x, F8 y) { return {x.a / y.a, x.b / y.b}; }
    friend F8 min(F8 x, F8 y) { return {min(x.a, y.a), min(x.b, y.b)}; }
    friend F8 max(F8 x, F8 y) { return {max(x.a, y.a), max(x.b, y.b)}; }
    friend F8 abs(F8 x) { return {abs(x.a), abs(x.b)}; }
    friend F8 flip(F8 x, F8 y) { return {flip(x.a, y.a), flip(x.b, y.b)}; }
    friend Lanes less_equal(F8 x, F8 y) {
        return {less_equal(x.a, y.a) | less_equal(x.b, y.b) << 4};
    }
    friend Lanes less(F8 x, F8 y) { return {less(x.a, y.a) | less(x.b, y.b) << 4}; }
};
#endif

/// Returns which of sixteen floats are at most `limit`.
inline Bits at_most(const float* sixteen, float limit) {
#if defined(__AVX512F__)
    return _mm512_cmp_ps_mask(_mm512_load_ps(sixteen), _mm512_set1_ps(limit), _CMP_LE_OQ);
#else
    const F8 end = F8::splat(limit);
    return bits(less_equal(F8::load(sixteen), end)) | bits(less_equal(F8::load(sixteen + 8), end))
                                                          << 8;
#endif
}

/// Returns which of eight words, but for the bits of `ignored`, are `word`.
inline Lanes equal(const std::uint32_t* words, std::uint32_t ignored, std::uint32_t word) {
#if defined(__AVX2__)
    const __m256i eight =
        _mm256_andnot_si256(_mm256_set1_epi32(static_cast<int>(ignored)),
                            _mm256_load_si256(reinterpret_cast<const __m256i*>(words)));
    const __m256i wanted = _mm256_set1_epi32(static_cast<int>(word));
#if defined(__AVX512VL__)
    return {_mm256_cmpeq_epi32_mask(eight, wanted)};
#else
    return {_mm256_castsi256_ps(_mm256_cmpeq_epi32(eight, wanted))};
#endif
#else
    Bits bits = 0;
    for (unsigned k = 0; k < 8; ++k)
        bits |= Bits{(words[k] & ~ignored) == word} << k;
    return {bits};
#endif
}

} // namespace hemilux::wide::HEMILUX_KERNELS
