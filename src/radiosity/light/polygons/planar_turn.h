#pragma once
// The turn of a path in the plane.

#include "geometry/vector.h"

#include <cmath>

namespace hemilux {

/// Returns +1 where the path a, b, c turns left, -1 where it turns right, and 0 where it is
/// straight or turns back. It returns 0 too where that is not certain, as coordinates may be wrong
/// by `rounding`.
[[nodiscard]] inline int turn_at(const Vec2& a, const Vec2& b, const Vec2& c, double rounding) {
    const Vec2 d = b - a, e = c - b;
    const double turn = cross(d, e);
    const double tolerance =
        4 * rounding * (std::abs(d.x) + std::abs(d.y) + std::abs(e.x) + std::abs(e.y));
    return turn > tolerance ? 1 : turn < -tolerance ? -1 : 0;
}

} // namespace hemilux
