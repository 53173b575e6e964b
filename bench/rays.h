#pragma once
// The rays that a solver shoots: from a point of each patch, cosine distributed, sorted by cell of
// the hemisphere; patches in spatial order.

#include "bvh/tracer.h"
#include "radiosity/scene/mesh.h"

#include <vector>

namespace hemilux::bench {

struct RaySet {
    std::vector<Vec3> directions; ///< all bundles one after the other
    std::vector<Bundle> bundles;
    std::vector<Ray> shuffled;         ///< the same rays in random order
    std::vector<std::uint32_t> origin; ///< shuffled[k] is ray origin[k] of the bundles
};

/// About `total` rays. The patches are taken from runs of neighbours, as if all were visited.
[[nodiscard]] RaySet make_rays(const Mesh& mesh, std::size_t per_patch, std::size_t total);

} // namespace hemilux::bench
