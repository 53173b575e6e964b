#pragma once
// A triangle on the unit sphere whose sides are arcs of great circles; here always within the upper
// hemisphere (z >= 0) of a patch's frame.

#include "geometry/polar_warp.h"
#include "geometry/vector.h"

#include <array>
#include <cmath>
#include <optional>

namespace hemilux {

class SphericalTriangle {
  public:
    SphericalTriangle() = default;
    /// Unit vectors with z >= 0, counter-clockwise seen from outside.
    SphericalTriangle(const Vec3& a, const Vec3& b, const Vec3& c);

    [[nodiscard]] const std::array<Vec3, 3>& vertices() const { return vertex_; }
    /// [sr] (Van Oosterom and Strackee 1983).
    [[nodiscard]] double solid_angle() const;
    /// Integral of cos(theta) over the triangle [sr], Lambert's closed form.
    [[nodiscard]] double projected_solid_angle() const;
    /// Whether a direction of the upper hemisphere lies inside; the edges belong to it.
    [[nodiscard]] bool contains(const Vec3& direction) const;

    /// A direction with density cos(theta) / projected_solid_angle, for u uniform in [0,1)^2: exact
    /// and continuous in u.
    [[nodiscard]] Vec3 sample(Vec2 u) const;
    /// Density of `sample` per steradian; 0 outside.
    [[nodiscard]] double density(const Vec3& direction) const;
    /// The u that `sample` maps to this direction; empty outside.
    [[nodiscard]] std::optional<Vec2> inverse(const Vec3& direction) const;

    /// The same distribution by rejection: the projection to the unit disc makes cosine-weighted
    /// directions uniform, so points uniform in the bounding box of the projection are kept when
    /// they lie inside. `uniform()` yields doubles uniform in [0,1). Several times faster than
    /// `sample` for triangles that are not slivers, but not stratified.
    template <class Uniform>
    [[nodiscard]] Vec3 sample_rejection(Uniform&& uniform) const;

  private:
    void include_in_box(const Vec3& a, const Vec3& b, const Vec3& normal);

    std::array<Vec3, 3> vertex_{};
    std::array<Vec3, 3> normal_{}; ///< of the planes of the edges, unit, inwards
    Vec2 box_low_{0.0}, box_extent_{0.0};
    PolarWarp warp_;
};

template <class Uniform>
Vec3 SphericalTriangle::sample_rejection(Uniform&& uniform) const {
    // After many misses the other way gives the same distribution: slivers stay exact and no shape
    // takes for ever.
    constexpr int most_tries = 64;
    for (int i = 0; i < most_tries; ++i) {
        const double x = box_low_.x + box_extent_.x * uniform();
        const double y = box_low_.y + box_extent_.y * uniform();
        const double z_squared = 1.0 - x * x - y * y;
        if (!(z_squared > 0))
            continue;
        const Vec3 d(x, y, std::sqrt(z_squared));
        if (glm::dot(normal_[0], d) >= 0 && glm::dot(normal_[1], d) >= 0 &&
            glm::dot(normal_[2], d) >= 0)
            return d;
    }
    const double u = uniform();
    return sample({u, uniform()});
}

} // namespace hemilux
