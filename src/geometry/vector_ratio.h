#pragma once
// Ratios by component, with a value where the divisor is 0.

#include "geometry/vector.h"

namespace hemilux {

/// Divides a by b by component; gives 0 where b is not above 0, and where it is a NaN.
[[nodiscard]] inline Vec3 ratio_or_zero(const Vec3& a, const Vec3& b) {
    const auto one = [](double x, double y) { return y > 0 ? x / y : 0.0; };
    return {one(a.x, b.x), one(a.y, b.y), one(a.z, b.z)};
}

} // namespace hemilux
