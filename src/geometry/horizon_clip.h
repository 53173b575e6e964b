#pragma once
// A polygon as a point of a surface sees it: in the surface's frame, without what lies below its
// horizon, and with the area of its projection by Lambert's formula.

#include "geometry/polygon.h"
#include "geometry/vector.h"

#include <array>

namespace hemilux {

/// A convex polygon of up to five directions with z >= 0, not of unit length. They run
/// counter-clockwise seen from outside the sphere, whichever side of the polygon is seen.
struct ClippedPolygon {
    std::array<Vec3, 5> vertex{};
    int size = 0; ///< 0: nothing above the horizon, or seen edge-on
};

/// Clips a polygon, whose `corners` are relative to the point, z being the surface's normal.
[[nodiscard]] ClippedPolygon clip_to_horizon(const std::array<Vec3, 4>& corners);

/// Returns the angle between a and b [rad] times the z of the unit normal of their plane. This is
/// an edge's share of twice the projected solid angle (Lambert 1760), and 0 for an edge without
/// length.
[[nodiscard]] double edge_term(const Vec3& a, const Vec3& b);

} // namespace hemilux
