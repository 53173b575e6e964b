#pragma once
// How rays leave a patch: points on it, and the frame of its hemisphere.

#include "geometry/frame.h"
#include "geometry/polygon_sampler.h"
#include "radiosity/scene/mesh.h"

#include <cstdint>

namespace hemilux {

struct PatchStart {
    PolygonSampler points;
    Frame frame; ///< Mesh::hemisphere_frame
    std::uint32_t patch, facet;

    PatchStart(const Mesh& mesh, std::uint32_t from)
        : points(mesh.patches()[from].shape), frame(mesh.hemisphere_frame(from)), patch(from),
          facet(mesh.patches()[from].facet) {}
};

} // namespace hemilux
