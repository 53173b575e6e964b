#pragma once
// Intersects a ray with a triangle without leaks along edges (Woop, Benthin and Wald 2013,
// "Watertight Ray/Triangle Intersection").
//
// The scene is moved and sheared so that the ray is the z axis. Whether it passes left or right of
// an edge then depends only on the two transformed end points, which neighbours share. Here the
// edge functions are doubles. Without contraction to FMA, a rounded difference of rounded products
// never has the wrong sign. It can only be zero instead; zeros are evaluated again exactly.

#include "geometry/numeric.h"
#include "geometry/polygon.h"

#include <cmath>
#include <utility>

namespace hemilux {

/// The point where a ray meets a triangle: t along the ray, and barycentric coordinates u, v of
/// corners 1 and 2 [-].
struct TriangleHit {
    double t, u, v;
    bool front;
};

/// This says what happens to a ray exactly on an edge.
enum class EdgeRule {
    inclusive, ///< both neighbours are hit: nothing leaks
    half_open  ///< of neighbours around an edge or vertex exactly one is hit: nothing is counted
               ///< twice
};

class ShearedRay {
  public:
    /// The direction must not be zero; it need not be of unit length.
    ShearedRay(const Vec3& origin, const Vec3& direction) : origin_(origin) {
        const Vec3 size = glm::abs(direction);
        z_ = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
        x_ = (z_ + 1) % 3;
        y_ = (x_ + 1) % 3;
        if (direction[z_] < 0) // keeps the winding
            std::swap(x_, y_);
        shear_ = {direction[x_] / direction[z_], direction[y_] / direction[z_], 1 / direction[z_]};
    }

    [[nodiscard]] Vec3 transform(const Vec3& point) const {
        const Vec3 p = point - origin_;
        return {p[x_] - shear_.x * p[z_], p[y_] - shear_.y * p[z_], shear_.z * p[z_]};
    }

  private:
    Vec3 origin_;
    Vec3 shear_{};
    int x_, y_, z_;
};

/// Returns twice the signed area of (0, a, b) seen along the ray, with the right sign.
[[nodiscard]] inline double edge_function(const Vec3& a, const Vec3& b) {
    const double e = a.x * b.y - a.y * b.x;
    return e != 0 ? e : difference_of_products(a.x, b.y, a.y, b.x);
}

/// Returns whether a triangle with the given winding owns points on its edge a -> b. Its neighbour
/// traverses the edge the other way and gets the other answer.
[[nodiscard]] inline bool owns_edge(const Vec3& a, const Vec3& b, bool counter_clockwise) {
    const double dx = b.x - a.x, dy = b.y - a.y;
    const bool up = dy > 0 || (dy == 0 && dx > 0);
    return up == counter_clockwise;
}

/// Intersects a triangle of transformed corners; t must lie in (t_min, t_max]. A NaN anywhere is a
/// miss.
template <EdgeRule rule>
[[nodiscard]] inline bool hit_triangle(const Vec3& a, const Vec3& b, const Vec3& c, double t_min,
                                       double t_max, TriangleHit& hit) {
    const double ea = edge_function(b, c); // weight of a
    const double eb = edge_function(c, a);
    const double ec = edge_function(a, b);
    if (!((ea >= 0 && eb >= 0 && ec >= 0) || (ea <= 0 && eb <= 0 && ec <= 0)))
        return false;
    const double sum = ea + eb + ec;
    if (!(sum != 0)) // seen edge-on
        return false;
    if constexpr (rule == EdgeRule::half_open) {
        const bool ccw = sum > 0;
        if ((ea == 0 && !owns_edge(b, c, ccw)) || (eb == 0 && !owns_edge(c, a, ccw)) ||
            (ec == 0 && !owns_edge(a, b, ccw)))
            return false;
    }
    const double t = (ea * a.z + eb * b.z + ec * c.z) / sum;
    if (!(t > t_min && t <= t_max))
        return false;
    // Looking along the ray, a front face runs clockwise in the sheared, right-handed frame.
    hit = {t, eb / sum, ec / sum, sum < 0};
    return true;
}

} // namespace hemilux
