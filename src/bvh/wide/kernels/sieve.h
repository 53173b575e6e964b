// Ray against triangle in floats, with a bound on the error: the test of Moeller and Trumbore
// (1997), after which a lane is surely missed, surely struck, or unsure.
//
// With A = corner - origin, edges e1, e2, normal N = e1 x e2 and direction d, the point struck has
// t = A.N / D, u = U / D, v = W / D where D = d.N, U = d.(e2 x A), W = d.(A x e1).
// No #pragma once: see simd.h.

#include "bvh/wide/wide_layout.h"

namespace hemilux::wide::HEMILUX_KERNELS {

template <class V>
struct V3 {
    V x, y, z;
    friend V3 operator-(V3 a, V3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    static V3 splat(const float* p) { return {V::splat(p[0]), V::splat(p[1]), V::splat(p[2])}; }
};

template <class V>
inline V dot(V3<V> a, V3<V> b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class V>
inline V3<V> cross(V3<V> a, V3<V> b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// |x| + |y| + |z|, at least the length.
template <class V>
inline V sum_abs(V3<V> a) {
    return abs(a.x) + abs(a.y) + abs(a.z);
}

template <class V>
inline V max_abs(V3<V> a) {
    return max(abs(a.x), max(abs(a.y), abs(a.z)));
}

/// Bounds the error of U, W, D and D - U - W. Counted over the roundings of corner, origin and
/// direction (2^-24 of at most 1), of the edges and of each operation, it is at most
/// 2^-24 E (78 |A| + 63 E + 11) with E the largest edge component and |A| the sum of components.
template <class V>
inline V error_bound(V3<V> a, V e) {
    return V::splat(error_share) * e * (sum_abs(a) + e + V::splat(error_offset));
}

/// What is known of the lanes of one test.
template <class V>
struct Sifted {
    V u, w, d, rest; ///< rest = D - U - W; struck where u, w, rest have one sign
    V error;

    Sifted(V u_, V w_, V d_, V error_) : u(u_), w(w_), d(d_), rest(d_ - u_ - w_), error(error_) {}

    /// Not surely missed, were the triangle's plane struck at a right t. NaN is not surely missed.
    [[nodiscard]] Bits maybe() const {
        const V zero = V::splat(0);
        return ~(less_equal(min(min(u, w), rest), zero - error) &
                 less_equal(error, max(max(u, w), rest))) &
               all();
    }
    [[nodiscard]] Bits inside() const {
        const V zero = V::splat(0);
        return less(error, min(min(u, w), rest)) | less(max(max(u, w), rest), zero - error);
    }
    [[nodiscard]] Bits front() const { return less(d, V::splat(0)); }
    static constexpr Bits all() { return (Bits{1} << V::lanes) - 1; }
};

/// Bounds of t where they can be told: elsewhere anything. `volume` is A.N, whose error is at most
/// E times that of D.
template <class V>
struct Interval {
    V low, high;
    Bits known;

    Interval(const Sifted<V>& s, V volume, V e) {
        const V inverse = V::splat(1) / s.d;
        const V t = volume * inverse;
        const V error = V::splat(2) * (e + abs(t)) * s.error * abs(inverse);
        low = t - error;
        high = t + error;
        known = less(V::splat(3) * s.error, abs(s.d));
    }
};

} // namespace hemilux::wide::HEMILUX_KERNELS
