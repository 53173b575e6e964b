#pragma once
// Whether the edges of a polygon of the plane cross each other.

#include "geometry/vector.h"

#include <span>

namespace hemilux {

/// Edges that only touch do not cross. Coordinates may be wrong by `rounding`. The edges are sorted
/// along the axis on which they are shorter, so the usual time is far below the O(n^2) of the worst
/// case.
[[nodiscard]] bool crosses_itself(std::span<const Vec2> corners, double rounding);

} // namespace hemilux
