#pragma once
// A triangle on the unit sphere whose sides are arcs of great circles. Here it always lies within
// the upper hemisphere (z >= 0) of a patch's frame.

#include "geometry/vector.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hemilux {

class SphericalTriangle {
  public:
    SphericalTriangle() = default;
    /// Takes unit vectors with z >= 0, counter-clockwise seen from outside.
    SphericalTriangle(const Vec3& a, const Vec3& b, const Vec3& c);

    [[nodiscard]] const std::array<Vec3, 3>& vertices() const { return vertex_; }
    /// Returns the solid angle [sr] (Van Oosterom and Strackee 1983).
    [[nodiscard]] double solid_angle() const;
    /// Returns the integral of cos(theta) over the triangle [sr], by Lambert's closed form.
    [[nodiscard]] double projected_solid_angle() const;

    /// Returns the unit normals of the planes of the sides, which point inwards.
    [[nodiscard]] const std::array<Vec3, 3>& planes() const { return normal_; }
    /// A parallelogram, or its first half, around the projection to the unit disc.
    struct Hull {
        Vec2 corner{0.0};
        std::array<Vec2, 2> edge{Vec2(0.0), Vec2(0.0)};
        bool is_half = false;
    };
    [[nodiscard]] const Hull& hull() const { return hull_; }

    /// Returns a direction with density cos(theta) / projected_solid_angle [1/sr], by rejection.
    /// The projection to the unit disc makes cosine-weighted directions uniform (Nusselt's
    /// analogy). So points uniform in a simple shape around the projection are kept when they lie
    /// inside. `uniform()` yields doubles uniform in [0,1). Slivers, which fill little of that
    /// shape, are sampled by a PolarWarp, with the same distribution.
    template <class Uniform>
    [[nodiscard]] Vec3 sample_rejection(Uniform&& uniform) const;

  private:
    /// Sets the bounding box, or the triangle with sides parallel to the chords if that is smaller.
    void set_hull();
    /// Returns a direction for u in [0,1)^2; where there is no area, some point between the
    /// vertices.
    [[nodiscard]] Vec3 sample_sliver(Vec2 u) const;
    [[nodiscard]] double reach(std::size_t edge, Vec2 towards) const;

    std::array<Vec3, 3> vertex_{};
    std::array<Vec3, 3> normal_{}; ///< unit normals of the planes of the edges, inwards
    Hull hull_;
};

template <class Uniform>
Vec3 SphericalTriangle::sample_rejection(Uniform&& uniform) const {
    constexpr int max_tries = 64;
    for (int i = 0; i < max_tries; ++i) {
        const double u = uniform(), v = uniform();
        // The second half is folded onto the first, without branches, which the processor would
        // mispredict.
        const auto fold = static_cast<double>(hull_.is_half & (u + v > 1));
        const Vec2 p =
            hull_.corner + std::abs(fold - u) * hull_.edge[0] + std::abs(fold - v) * hull_.edge[1];
        const double z_squared = 1.0 - glm::dot(p, p);
        const Vec3 d(p, std::sqrt(std::max(z_squared, 0.0)));
        const double inside = std::min(std::min(glm::dot(normal_[0], d), glm::dot(normal_[1], d)),
                                       glm::dot(normal_[2], d));
        if (z_squared > 0 && inside >= 0)
            return d;
    }
    const double u = uniform();
    return sample_sliver({u, uniform()});
}

} // namespace hemilux
