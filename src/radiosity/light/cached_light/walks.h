#pragma once
// Walks from points of surfaces, which find what the light that gathers read lacks.
//
// A gather from x reads the light h of each point y that its rays meet. A walk goes on from y as a
// path: at each of its vertices one ray goes to an emitter (of each kind) and one at random, which
// reads h where it lands and goes on with the chance s, the largest reflectance there,
//     i(y) = D(y) + e(z) + rho(z) (h(z) + xi / s (i(z) - h(z))),
// where i and h are irradiances and e is the emission that no ray to an emitter finds. So i(y) -
// h(y) is an unbiased sample of what is missing at y, whatever h is. The better h, the smaller its
// noise.

#include "bvh/tracer.h"
#include "radiosity/engine/emitters/point_emitters.h"
#include "radiosity/engine/emitters/reached_emitters.h"
#include "radiosity/engine/rays/surface_point.h"
#include "radiosity/light/cached_light/irradiance_cells.h"
#include "radiosity/light/cached_light/surface_light.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;

struct WalkStart {
    SurfacePoint at;
    Vec2 direction;     ///< uniform numbers of the first ray at random
    std::uint64_t seed; ///< random numbers of all else
};

/// What one walk finds, as irradiance at its start [W/m2].
struct WalkLight {
    Vec3 direct{0.0};   ///< light of emitters
    Vec3 read{0.0};     ///< reflected light, as the first ray reads it
    Vec3 residual{0.0}; ///< what that lacks, an unbiased sample
    /// Whether the first ray ends so near that gathers do not read what is known there, but walk
    /// on themselves.
    bool is_near = false;
};

class Walks {
  public:
    Walks(const Mesh& mesh, const Tracer& tracer, const SurfaceLight& light)
        : mesh_(mesh), tracer_(tracer), light_(light), emitters_(mesh), points_(mesh) {}

    /// Takes a walk from each start; adds a sample of the residual for each place where one
    /// landed. Returns the number of rays.
    std::uint64_t take(std::span<const WalkStart> starts, std::span<WalkLight> found,
                       std::vector<IrradianceCells::Sample>& samples) const;

  private:
    struct Vertex {
        SurfacePoint at;
        std::uint32_t before;   ///< the vertex that it was met from; none: it is a start
        Vec3 weight{0.0};       ///< of its residual, as irradiance at that vertex
        Vec3 irradiance{0.0};   ///< as gathers read it
        Vec3 of_patch{0.0};     ///< the same of the patch alone
        Vec3 found{0.0};        ///< a sample of the irradiance
        std::uint64_t seed = 0; ///< of its random numbers
        Vec2 direction{0.0};    ///< uniform numbers of its ray at random
    };
    struct Work;
    void trace(std::uint32_t begin, std::uint32_t end, Work& work,
               std::span<WalkLight> found) const;

    const Mesh& mesh_;
    const Tracer& tracer_;
    const SurfaceLight& light_;
    ReachedEmitters emitters_;
    PointEmitters points_;
};

} // namespace hemilux
