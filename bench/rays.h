#pragma once
// The rays that a solver shoots: from a point of each patch, cosine distributed, sorted by cell of
// the hemisphere; patches in spatial order.

#include "bvh/tracer.h"
#include "radiosity/paper/scene/mesh.h"

#include <cstdint>
#include <vector>

namespace hemilux::bench {

struct RaySet {
    std::vector<Ray> sorted;   ///< patch by patch, those of a patch by cell
    std::vector<Ray> shuffled; ///< the same rays in random order
};

/// About `total` rays. The patches are taken from runs of neighbours, as if all were visited.
[[nodiscard]] RaySet make_rays(const Mesh& mesh, std::size_t per_patch, std::size_t total);

/// Rays with the facets that they go to, which do not occlude them.
struct ShadowRaySet {
    std::vector<Ray> rays;
    std::vector<std::uint32_t> targets;
};

/// Shadow rays: from where rays of `set` start to where others do, picked at random among those
/// that face each other. They end just before the facet they go to.
[[nodiscard]] ShadowRaySet make_shadow_rays(const Mesh& mesh, const RaySet& set);

} // namespace hemilux::bench
