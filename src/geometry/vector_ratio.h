#pragma once
// Ratios by component that know what to do with nothing.

#include "geometry/vector.h"

namespace hemilux {

/// a / b by component; 0 where b is not above 0, and where it is a NaN.
[[nodiscard]] inline Vec3 ratio_or_zero(const Vec3& a, const Vec3& b) {
    const auto one = [](double x, double y) { return y > 0 ? x / y : 0.0; };
    return {one(a.x, b.x), one(a.y, b.y), one(a.z, b.z)};
}

} // namespace hemilux
