#pragma once
// Defines how rays leave a patch: from points on it, in directions of its hemisphere.

#include "bvh/tracer.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/scene/mesh.h"

#include <cstdint>

namespace hemilux {

struct PatchStart {
    PolygonSampler points;
    Frame frame; ///< its z is the patch's normal
    std::uint32_t patch, facet;

    PatchStart(const Mesh& mesh, std::uint32_t from, const Frame& axes)
        : points(mesh.patches()[from].shape), frame(axes), patch(from),
          facet(mesh.patches()[from].facet) {}
    /// Uses the axes of the patch's densities (Mesh::hemisphere_frame).
    PatchStart(const Mesh& mesh, std::uint32_t from)
        : PatchStart(mesh, from, mesh.hemisphere_frame(from)) {}
    /// Returns a start in any axes, for directions to which axes do not matter.
    [[nodiscard]] static PatchStart in_any_axes(const Mesh& mesh, std::uint32_t from) {
        return {mesh, from, Frame::from_normal(mesh.patches()[from].normal)};
    }

    /// Returns a ray in a direction of the frame. `point` is one of the unit square, which is
    /// spread evenly over the patch.
    [[nodiscard]] Ray ray(Vec2 point, const Vec3& direction) const {
        return {
            .origin = points.sample(point), .direction = frame.to_world(direction), .from = facet};
    }
    /// Returns a ray from a uniform point, by Lambert's law.
    [[nodiscard]] Ray cosine_ray(Rng& rng) const {
        const double u = rng.uniform(), v = rng.uniform();
        return ray({u, v}, sample_cosine(rng));
    }
};

} // namespace hemilux
