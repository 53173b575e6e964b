#pragma once
// Computes what two polygons exchange with nothing in between, by contour integration.
//
// By Stokes' theorem (Sparrow 1963; Goral et al. 1984)
//
//     2 pi A F = | sum over edges e of one, f of the other of  e.f  int_e int_f  ln r  df de |,
//
// where e.f is the cosine between the edges. The inner integral is elementary, and the outer one is
// done by adaptive Gauss-Legendre quadrature. Common edges and corners are integrable
// singularities.

#include "geometry/polygon.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace hemilux {

struct Plane {
    Vec3 point, normal; ///< the normal has unit length
    [[nodiscard]] double height(const Vec3& p) const { return glm::dot(p - point, normal); }
};

/// The corners of a convex polygon.
using Outline = std::vector<Vec3>;
[[nodiscard]] Outline outline_of(const Polygon& polygon);
/// Calls keep(corner) for the corners of the part of a polygon that is in front of a plane, in
/// order (Sutherland and Hodgman 1974). Returns the height of the highest corner over it.
template <class Keep>
double clip_in_front(std::span<const Vec3> corners, const Plane& plane, const Keep& keep) {
    double highest = 0;
    double of_next = corners.empty() ? 0 : plane.height(corners[0]);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3 &a = corners[i], &b = corners[i + 1 < corners.size() ? i + 1 : 0];
        const double of_this = of_next;
        of_next = plane.height(b);
        highest = std::max(highest, of_this);
        if (of_this >= 0)
            keep(a);
        if ((of_this < 0 && of_next > 0) || (of_this > 0 && of_next < 0))
            keep(glm::mix(a, b, of_this / (of_this - of_next)));
    }
    return highest;
}
/// Returns the part in front of a plane; empty where nothing rises above it by more than `rounding`
/// [length].
[[nodiscard]] Outline in_front(const Outline& outline, const Plane& plane, double rounding);

/// The parts of two polygons that are in front of each other; both empty where there are none.
struct FacingPair {
    Outline from, to;
};
[[nodiscard]] FacingPair facing_parts(const Polygon& from, const Polygon& to, double rounding);

/// Returns A F [the unit of the polygons' areas] from the front of one to the front of the other.
/// The error is below 1e-10 of the smaller area.
[[nodiscard]] double exchange_area(const Polygon& from, const Polygon& to);
/// Computes the same for parts that face each other.
[[nodiscard]] double exchange_area(const Outline& from, const Outline& to, double smaller_area);

} // namespace hemilux
