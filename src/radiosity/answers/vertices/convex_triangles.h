#pragma once
// Triangles of a convex polygon that may have corners within straight sides.

#include "geometry/vector.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

/// Returns the Delaunay triangulation, whose triangles have the polygon's sense of rotation. No
/// corner lies on a side of a triangle that does not end there. Where the polygon has an area, each
/// triangle has one.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>>
convex_triangles(std::span<const Vec3> corners);

} // namespace hemilux
