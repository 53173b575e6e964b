#pragma once
// Small numerical helpers with a name for each hazard they avoid.

#include "geometry/vector.h"

#include <cmath>

namespace hemilux {

/// Returns the square root, where a rounding error below zero counts as zero. A NaN stays a NaN.
[[nodiscard]] inline double safe_sqrt(double x) { return x < 0 ? 0.0 : std::sqrt(x); }

/// Computes a b - c d with an error below 1.5 ulp and, short of underflow, the right sign
/// (Jeannerod, Louvet and Muller 2013, Kahan's algorithm).
[[nodiscard]] inline double difference_of_products(double a, double b, double c, double d) {
    const double cd = c * d;
    const double error = std::fma(-c, d, cd);
    return std::fma(a, b, -cd) + error;
}

/// Returns the unit vector along a vector of any length above 0. The squares of very long and very
/// short vectors would overflow or underflow.
[[nodiscard]] inline Vec3 direction_of(const Vec3& v) {
    return glm::normalize(v / std::abs(v[largest_axis(v)]));
}

/// Divides a by b by component; gives 0 where b is not above 0, and where it is a NaN.
[[nodiscard]] inline Vec3 ratio_or_zero(const Vec3& a, const Vec3& b) {
    const auto one = [](double x, double y) { return y > 0 ? x / y : 0.0; };
    return {one(a.x, b.x), one(a.y, b.y), one(a.z, b.z)};
}

} // namespace hemilux
