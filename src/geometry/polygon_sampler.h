#pragma once
// Points uniform over one polygon, many of them: what does not depend on the point is worked out
// once.

#include "geometry/polygon.h"

#include <cmath>

namespace hemilux {

class PolygonSampler {
  public:
    explicit PolygonSampler(const Polygon& polygon);

    /// For u uniform in [0,1)^2; keeps stratification of u.
    [[nodiscard]] Vec3 sample(Vec2 u) const {
        if (parallelogram_)
            return corner_ + u.x * edge_[0] + u.y * edge_[1];
        if (!(u.x >= split_ && split_ < 1))
            return sample_triangle(edge_[0], edge_[1], {u.x / split_, u.y});
        return sample_triangle(edge_[2], edge_[3], {(u.x - split_) / (1.0 - split_), u.y});
    }

  private:
    /// The square root turns equal shares of u.x into strips of equal area.
    [[nodiscard]] Vec3 sample_triangle(const Vec3& first, const Vec3& across, Vec2 u) const {
        return corner_ + std::sqrt(u.x) * (first + u.y * across);
    }

    Vec3 corner_;                ///< corner 0, from which all is measured
    std::array<Vec3, 4> edge_{}; ///< from it and across, of the half (0,1,2) and of (0,2,3)
    double split_ = 1;           ///< share of the half (0,1,2); 1 for triangles
    bool parallelogram_ = false; ///< needs no choice between halves
};

} // namespace hemilux
