#pragma once
// Intersects a ray with one facet. The BVH and the brute-force referee share it, so that a test of
// one against the other tests the traversal alone.

#include "bvh/tracer.h"
#include "geometry/watertight.h"

#include <limits>
#include <span>

namespace hemilux {

/// Corner indices into the vertices; [3] == [2] for a triangle.
using FacetCorners = std::array<std::uint32_t, 4>;

/// The facets that a tracer finds.
struct FacetSoup {
    std::span<const Vec3> vertices;
    std::span<const FacetCorners> facets;
};

/// Returns true and fills in the hit if the ray hits facet `corners` at a t in (ray.t_min, t_max].
/// A ray may hit a quad that is not quite planar twice: the nearer hit counts. A ray through the
/// diagonal hits the first half alone, since by rounding t may differ between the two. So the
/// answer does not depend on what was hit before.
template <EdgeRule rule>
[[nodiscard]] inline bool hit_facet(std::span<const Vec3> vertices, const FacetCorners& corners,
                                    const ShearedRay& sheared, double t_min, double t_max,
                                    Hit& hit) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const auto in_range = [&](double t) { return t > t_min && t <= t_max; };
    const Vec3 p0 = sheared.transform(vertices[corners[0]]);
    const Vec3 p1 = sheared.transform(vertices[corners[1]]);
    const Vec3 p2 = sheared.transform(vertices[corners[2]]);
    TriangleHit found, other;
    const bool pierced = hit_triangle<rule>(p0, p1, p2, -infinity, infinity, found);
    const bool in_first = pierced && in_range(found.t);
    const bool on_diagonal = pierced && found.u == 0;
    bool second_half = corners[2] != corners[3] && !on_diagonal;
    if (second_half) {
        const Vec3 p3 = sheared.transform(vertices[corners[3]]);
        second_half = hit_triangle<rule>(p0, p2, p3, t_min, in_first ? found.t : t_max, other);
    }
    if (second_half)
        found = other;
    else if (!in_first)
        return false;
    hit.t = found.t;
    hit.u = found.u;
    hit.v = found.v;
    hit.second_half = second_half;
    hit.front = found.front;
    return true;
}

/// Returns whether a hit at t on `facet` comes before the best so far. Ties go to the smaller
/// index, so that the answer does not depend on the order of visits.
[[nodiscard]] inline bool comes_before(double t, std::uint32_t facet, const Hit& best) {
    return t < best.t || (t == best.t && facet < best.facet);
}

} // namespace hemilux
