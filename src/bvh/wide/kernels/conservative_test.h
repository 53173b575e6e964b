// Ray against triangle in floats, with a bound on the error. This is the test of Moeller and
// Trumbore (1997), after which a lane is certainly missed, certainly hit, or uncertain.
//
// A is corner - origin, e1 and e2 are edges, N = e1 x e2 is the normal and d the direction. The
// point hit then has t = A.N / D, u = U / D, v = W / D where D = d.N, U = d.(e2 x A), W = d.(A x
// e1). No #pragma once: see simd.h.

#include "bvh/wide/wide_layout.h"

namespace hemilux::wide::HEMILUX_KERNELS {

struct V3 {
    F8 x, y, z;
    friend V3 operator-(V3 a, V3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    static V3 splat(const float* p) { return {F8::splat(p[0]), F8::splat(p[1]), F8::splat(p[2])}; }
};

inline F8 dot(V3 a, V3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

inline V3 cross(V3 a, V3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Returns |x| + |y| + |z|, which is at least the length.
inline F8 sum_abs(V3 a) { return abs(a.x) + abs(a.y) + abs(a.z); }

inline F8 max_abs(V3 a) { return max(abs(a.x), max(abs(a.y), abs(a.z))); }

/// Bounds the error of U, W, D and D - U - W. The roundings of corner, origin and direction (2^-24
/// of each component), of the edges and of each operation are counted. The error is then at most
/// 2^-24 E (78 |A| + 63 E + 11 C) with E the largest edge component, |A| the sum of components and
/// C the largest component of corner and origin, which is at most |A| + `origin`.
inline F8 error_bound(V3 a, F8 e, float origin) {
    return F8::splat(error_share) * e *
           (F8::splat(1 + error_offset) * sum_abs(a) + e + F8::splat(error_offset * origin));
}

/// The outcome of one test, lane by lane.
struct EdgeFunctions {
    F8 u, w, d, rest; ///< rest = D - U - W; hit where u, w, rest have one sign
    F8 error;

    EdgeFunctions(F8 u_, F8 w_, F8 d_, F8 error_)
        : u(u_), w(w_), d(d_), rest(d_ - u_ - w_), error(error_) {}

    /// Returns the lanes that are not certainly missed if the triangle's plane is hit at a right t.
    /// A NaN is not certainly missed.
    [[nodiscard]] Bits may_hit() const {
        const F8 zero = F8::splat(0);
        constexpr Bits all = (Bits{1} << width) - 1;
        return ~(less_equal(min(min(u, w), rest), zero - error) &
                 less_equal(error, max(max(u, w), rest))) &
               all;
    }
    [[nodiscard]] Bits inside() const {
        const F8 zero = F8::splat(0);
        return less(error, min(min(u, w), rest)) | less(max(max(u, w), rest), zero - error);
    }
    [[nodiscard]] Bits front() const { return less(d, F8::splat(0)); }
};

/// Bounds of t where they are known; elsewhere they mean nothing. `volume` is A.N, whose error is
/// at most E times that of D.
struct Interval {
    F8 low, high;
    Bits known;

    Interval(const EdgeFunctions& s, F8 volume, F8 e) {
        const F8 inverse = F8::splat(1) / s.d;
        const F8 t = volume * inverse;
        const F8 error = F8::splat(2) * (e + abs(t)) * s.error * abs(inverse);
        low = t - error;
        high = t + error;
        known = less(F8::splat(3) * s.error, abs(s.d));
    }
};

} // namespace hemilux::wide::HEMILUX_KERNELS
