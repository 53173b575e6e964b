#pragma once
// A polygon seen from a point in space: its solid angle, and directions uniform over it.
//
// A light without extent sends I dOmega into each solid angle. So directions uniform in solid angle
// carry equal power where I is constant, however near the light is to the polygon. Points uniform
// over the area would carry most of it in a few of them.

#include "geometry/polygon.h"

#include <array>

namespace hemilux {

class SeenPolygon {
  public:
    SeenPolygon(const Vec3& point, const Polygon& polygon);

    /// Returns the solid angle [sr], from either side of the polygon (Van Oosterom and Strackee
    /// 1983). It is right to its last digits also where it is small.
    [[nodiscard]] double solid_angle() const { return solid_angle_[0] + solid_angle_[1]; }
    /// Returns a unit direction uniform over the polygon for u uniform in [0,1)^2 (Arvo 1995,
    /// "Stratified sampling of spherical triangles"). It loses digits as the solid angle becomes
    /// small: at 1e-4 it is good to 1e-11 of the polygon's width. The result is not finite where a
    /// triangle is seen edge-on.
    [[nodiscard]] Vec3 sample(Vec2 u) const;

  private:
    std::array<Vec3, 4> to_corner_;       ///< unit
    std::array<double, 2> solid_angle_{}; ///< of the triangles (0,1,2) and (0,2,3)
};

} // namespace hemilux
