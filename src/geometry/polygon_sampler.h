#pragma once
// Samples many points uniformly over one polygon; what does not depend on the point is computed
// once.
//
// A quad's bilinear map p = a + s e + t f + s t g stretches areas by J0 + s J1 + t J2, if the quad
// is planar. So s, then t follow linear densities (Shirley, Laine, Hart, Pharr et al. 2019,
// "Sampling transformations zoo", bilinear patches). A parallelogram is the case J1 = J2 = 0 and
// needs no switch: corners moved by a rounding error move the points by no more.

#include "geometry/polygon.h"

#include <cmath>

namespace hemilux {

class PolygonSampler {
  public:
    explicit PolygonSampler(const Polygon& polygon);

    /// Returns a point uniform over the polygon for u uniform in [0,1)^2. It keeps stratification
    /// of u.
    [[nodiscard]] Vec3 sample(Vec2 u) const {
        if (triangle_) // the square root turns equal shares of u.x into strips of equal area
            return corner_ + std::sqrt(u.x) * (first_ + u.y * second_);
        if (even_)
            return corner_ + u.x * first_ + u.y * second_;
        const double s = between(u.x, at_[0] + at_[2], at_[1] + at_[3]);
        const double t =
            between(u.y, at_[0] + s * (at_[1] - at_[0]), at_[2] + s * (at_[3] - at_[2]));
        return corner_ + s * first_ + t * (second_ + s * twist_);
    }

  private:
    /// Returns the place that has the share u of a linear density below it. The density is a at 0
    /// and b at 1, both >= 0.
    [[nodiscard]] static double between(double u, double a, double b) {
        const double root = a + std::sqrt(a * a + u * (b * b - a * a));
        return root > 0 ? u * (a + b) / root : u;
    }

    bool triangle_, even_; ///< even: J1 = J2 = 0
    Vec3 corner_;          ///< corner 0, from which all is measured
    /// These are a triangle's edge at the corner and the one across, or a quad's two edges there: e
    /// and f.
    Vec3 first_, second_;
    Vec3 twist_{0.0};            ///< g
    std::array<double, 4> at_{}; ///< J at (0,0), (1,0), (0,1), (1,1)
};

} // namespace hemilux
