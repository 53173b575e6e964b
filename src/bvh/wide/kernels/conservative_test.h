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

/// Where a ray meets the planes of eight triangles: inside of their edges or outside.
struct EdgeFunctions {
    F8 d, error;
    F8 depth; ///< the least of U, W and D - U - W, where they have one sign; else it is negative

    EdgeFunctions(F8 u, F8 w, F8 d_, F8 error_) : d(d_), error(error_) {
        const F8 rest = d - u - w;
        depth = max(min(min(u, w), rest), F8::splat(0) - max(max(u, w), rest));
    }
    /// Returns the lanes that are missed if the triangle's plane is hit at a right t. A NaN is not
    /// certainly missed.
    [[nodiscard]] Lanes outside() const { return less_equal(error, F8::splat(0) - depth); }
    [[nodiscard]] Lanes inside() const { return less(error, depth); }
    [[nodiscard]] Bits front() const { return bits(less(d, F8::splat(0))); }
};

/// The lanes in which a ray meets the plane of a triangle certainly before its end, or certainly
/// not between its start and its end.
struct Span {
    Lanes within, beyond;
};

/// Bounds of t where they are known; elsewhere they mean nothing. `volume` is A.N, whose error is
/// at most E times that of D.
struct Interval {
    F8 low, high;
    Lanes known;

    Interval(const EdgeFunctions& s, F8 volume, F8 e) {
        const F8 inverse = F8::splat(1) / s.d;
        const F8 t = volume * inverse;
        const F8 error = F8::splat(2) * (e + abs(t)) * s.error * abs(inverse);
        low = t - error;
        high = t + error;
        known = less(F8::splat(3) * s.error, abs(s.d));
    }
    [[nodiscard]] Span before(const FloatRay& ray, const Nearest& end) const {
        return {known & less(F8::splat(ray.t_min_high), low) & less(high, F8::splat(end.low)),
                known & (less(F8::splat(end.high), low) | less(high, F8::splat(ray.t_min_low)))};
    }
};

/// Finds the same where t itself is not needed, without dividing by D: the volume is compared with
/// the ends of the ray times |D|. The error of their difference is at most E + |t| times that of D;
/// twice as much covers the rounding of these lines too.
inline Span span_before(const EdgeFunctions& s, F8 volume, F8 e, const FloatRay& ray,
                        const Nearest& end) {
    const F8 d = abs(s.d), v = flip(volume, s.d), twice = s.error + s.error;
    const F8 error_at_start = twice * (e + F8::splat(__builtin_fabsf(ray.t_min_high)));
    const F8 error_at_end = twice * (e + F8::splat(__builtin_fabsf(end.high)));
    const auto after = [&](float t) { return v - F8::splat(t) * d; };
    const auto before = [&](float t) { return F8::splat(t) * d - v; };
    const F8 zero = F8::splat(0);
    return {less(s.error, d) & less(error_at_start, after(ray.t_min_high)) &
                less(error_at_end, before(end.low)),
            less(s.error, d) & (less(after(ray.t_min_low), zero - error_at_start) |
                                less(before(end.high), zero - error_at_end))};
}

} // namespace hemilux::wide::HEMILUX_KERNELS
