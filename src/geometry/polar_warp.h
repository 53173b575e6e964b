#pragma once
// The unit square mapped to the cosine-weighted directions of a spherical triangle, exactly and
// continuously.
//
// Projected to the unit disc, cosine-weighted directions are uniform (Nusselt's analogy), and a
// great circle with plane normal m is an ellipse about the pole. In polar coordinates (r, phi)
//
//     r^2(phi) = m_z^2 / (m_z^2 + h^2),   h(phi) = m_x cos(phi) + m_y sin(phi),
//
// and the area between the pole and an arc is m_z Gamma / 2, Gamma being the length of the arc and
// m of unit length (Lambert 1760). So u.x chooses phi by area, and u.y chooses r^2 between the
// inner and the outer arc. If the pole is inside the triangle, there is no inner arc and Gamma is
// given in closed form. Otherwise the area is a difference of two such terms, which Halley's
// iteration inverts.

#include "geometry/vector.h"

#include <array>

namespace hemilux {

class PolarWarp {
  public:
    PolarWarp() = default;
    /// Takes unit vectors with z >= 0, counter-clockwise seen from outside.
    PolarWarp(const Vec3& a, const Vec3& b, const Vec3& c);

    /// Returns the projected solid angle [sr]; 0 for a triangle without area.
    [[nodiscard]] double area() const { return area_; }
    /// Returns the direction for u in [0,1]^2. Requires area() > 0.
    [[nodiscard]] Vec3 sample(Vec2 u) const;

  private:
    /// An arc from the apex of a sector; m = (h_0, h_1, m_z) along the apex's azimuth, across it
    /// and along the pole, not of unit length.
    struct Arc {
        double h_0 = 0, h_1 = 0, m_z = 0, length = 1;
        [[nodiscard]] double gamma(Vec2 azimuth) const;
        [[nodiscard]] double area(Vec2 azimuth) const;
    };
    /// The points where a meridian crosses two arcs.
    struct Crossing {
        Vec2 r_squared, z_squared; ///< values of the first and the second arc
        double difference;         ///< r_squared.x - r_squared.y, without cancellation
    };
    /// The part of the triangle between two meridians, of which the first goes through a vertex,
    /// the apex. Azimuths are (cos, sin) of the angle from the apex.
    struct Sector {
        Vec2 axis{1, 0}, across{0, 1};
        double rho = 0, height = 1; ///< place of the apex
        Arc first, second;          ///< the second is unused in a fan
        double range = 0;           ///< range of the azimuth [rad]
        double area = 0;

        [[nodiscard]] Vec2 azimuth_of(const Vec3& direction) const;
        [[nodiscard]] Vec3 direction(Vec2 azimuth, double r, double z) const;
        [[nodiscard]] Crossing crossing(Vec2 azimuth) const;
        [[nodiscard]] double area_before(Vec2 azimuth) const;
        [[nodiscard]] double azimuth_at(double target) const;
    };

    [[nodiscard]] static Sector sector(const Vec3& apex, double side);
    [[nodiscard]] static Arc arc(const Sector& sector, const Vec3& apex, const Vec3& end);
    [[nodiscard]] static Sector fan_sector(const Vec3& from, const Vec3& to);
    [[nodiscard]] static Sector wedge(const Vec3& apex, const Vec3& middle, const Vec3& far,
                                      double side);
    [[nodiscard]] Vec3 sample_fan(double target, double radial) const;
    [[nodiscard]] Vec3 sample_wedge(const Sector& wedge, double target, double radial) const;

    /// If the pole is inside, there is one sector below each edge. Otherwise there are two wedges,
    /// from the first and from the last vertex in azimuth, which meet at the meridian of the middle
    /// one.
    std::array<Sector, 3> sector_{};
    bool fan_ = true;
    double area_ = 0;
};

} // namespace hemilux
