#pragma once
// Form factors in closed form. The number in brackets is that of Howell's catalogue of radiation
// configuration factors. Every length is positive; all factors are in [0,1].

#include "geometry/polygon.h"
#include "geometry/vector.h"

namespace hemilux {

/// Between equal, parallel, directly opposed rectangles a x b at distance c; X = a/c, Y = b/c
/// [C-11].
[[nodiscard]] double opposed_rectangles(double x, double y);

/// From a point of a surface with a unit normal to a polygon, seen from either side: Lambert's
/// formula (1760; Baum, Rushmeier and Winget 1989, eq. 6) after the part below the surface's plane
/// has been cut off. 0 for a polygon seen edge-on, also where the point lies on its edge.
[[nodiscard]] double point_to_polygon(const Vec3& point, const Vec3& normal,
                                      const Polygon& polygon);

} // namespace hemilux
