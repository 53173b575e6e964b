#pragma once
// The rays that a solver shoots: from a point of each patch, cosine distributed, sorted by cell of
// the hemisphere; patches in spatial order.

#include "bvh/tracer.h"
#include "radiosity/paper/scene/mesh.h"

#include <vector>

namespace hemilux::bench {

struct RaySet {
    std::vector<Ray> sorted;   ///< patch by patch, those of a patch by cell
    std::vector<Ray> shuffled; ///< the same rays in random order
};

/// About `total` rays. The patches are taken from runs of neighbours, as if all were visited.
[[nodiscard]] RaySet make_rays(const Mesh& mesh, std::size_t per_patch, std::size_t total);

} // namespace hemilux::bench
