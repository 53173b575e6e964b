#pragma once
// Paths of light as a quick look at a scene needs them: from emitters into the room, with
// directions by the cosine law, facet by facet and not patch by patch.

#include "bvh/tracer.h"
#include "radiosity/mesh.h"
#include "radiosity/rng.h"

#include <vector>

namespace hemilux {

/// One side of a facet: where a ray leaves from.
struct FacetSide {
    std::uint32_t facet;
    bool back;
};

/// What leaves a point of a side, by the cosine law. It starts a little off the plane, so that
/// layers that lie in one place (stacked_facets.h) do not hide each other.
[[nodiscard]] Ray diffuse_ray(const Mesh& mesh, FacetSide side, const Vec3& point, Rng& rng);
/// The same from a random point of the side.
[[nodiscard]] Ray diffuse_ray(const Mesh& mesh, FacetSide side, Rng& rng);
[[nodiscard]] inline Vec3 point_of(const Ray& ray, const Hit& hit) {
    return ray.origin + hit.t * ray.direction;
}

/// What a facet emits on one side, all channels together, in the local frame; 0 for what is no
/// finite number.
[[nodiscard]] double power_of(const Mesh& mesh, std::uint32_t facet);

/// How many of about `count` items each facet gets, in proportion to its weight: systematic
/// sampling, so each has its share to within one.
[[nodiscard]] std::vector<std::uint32_t> shares_of(const std::vector<double>& weights,
                                                   std::uint32_t count);

} // namespace hemilux
