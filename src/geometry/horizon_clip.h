#pragma once
// A polygon as a point of a surface sees it: in the surface's frame, without what lies below its
// horizon, and with the area of its projection by Lambert's formula.

#include "geometry/polygon.h"
#include "geometry/vector.h"

#include <array>

namespace hemilux {

/// Up to five directions, not of unit length, with z >= 0; convex, counter-clockwise seen from
/// outside the sphere, whichever side of the polygon is seen.
struct ClippedPolygon {
    std::array<Vec3, 5> vertex{};
    int size = 0; ///< 0: nothing above the horizon, or seen edge-on
};

/// `corners` are those of a polygon relative to the point, z being the surface's normal.
[[nodiscard]] ClippedPolygon clip_to_horizon(const std::array<Vec3, 4>& corners);

/// Angle between a and b times the z of the unit normal of their plane: an edge's share of twice
/// the projected solid angle (Lambert 1760). 0 for an edge without length.
[[nodiscard]] double edge_term(const Vec3& a, const Vec3& b);

} // namespace hemilux
