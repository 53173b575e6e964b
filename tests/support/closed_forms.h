#pragma once
// Form factors in closed form, for tests. Numbers in brackets are those of Howell's catalogue of
// radiation configuration factors. Every length is positive; all factors are in [0,1].

#include "geometry/polygon.h"

namespace hemilux::test {

/// Between equal, parallel, directly opposed rectangles a x b at distance c; X = a/c, Y = b/c
/// [C-11].
[[nodiscard]] double opposed_rectangles(double x, double y);

/// From a rectangle of width w to one of height h perpendicular to it, with a common edge of
/// length l; H = h/l, W = w/l [C-14].
[[nodiscard]] double perpendicular_rectangles(double h, double w);

/// From a disk of radius r1 to a parallel one of radius r2 on the same axis at distance h;
/// R1 = r1/h, R2 = r2/h [C-41].
[[nodiscard]] double coaxial_disks(double r1, double r2);

/// From a point to a parallel rectangle a x b at height c, with one corner straight above the
/// point; A = a/c, B = b/c [B-3].
[[nodiscard]] double point_under_corner(double a, double b);

/// From a point of a surface with a unit normal to a polygon, seen from either side
/// (ProjectedPolygon).
[[nodiscard]] double point_to_polygon(const Vec3& point, const Vec3& normal,
                                      const Polygon& polygon);

} // namespace hemilux::test
