#pragma once
// The light at points of surfaces, by nothing but paths of rays: no solution, no patches and no
// gather have a part in it. Slow and obviously right, a reference for what the program reports.

#include "radiosity/light/final_gather/surface_points.h"
#include "radiosity/paper/scene/mesh.h"

#include "bvh/tracer.h"

#include <array>
#include <cstddef>
#include <random>
#include <vector>

namespace hemilux::bench {

class PathReference {
  public:
    /// Both outlive it.
    PathReference(const Mesh& mesh, const Tracer& tracer);

    /// The irradiance that paths find [W/m2]: right on average. From each vertex goes one ray to a
    /// point of an emitter and one at random, which may meet an emitter too; both ways to it are
    /// joined by the balance heuristic (Veach and Guibas 1995). The first two rays of the paths are
    /// spread evenly (Kronecker sequence with a random shift: Cranley and Patterson 1976).
    [[nodiscard]] Vec3 irradiance(const SurfacePoint& at, std::size_t paths,
                                  std::mt19937_64& numbers) const;

  private:
    /// Uniform numbers of a vertex: for a point of an emitter, and for a direction.
    struct Vertex {
        std::array<double, 3> emitter;
        std::array<double, 2> direction;
    };
    [[nodiscard]] Vec3 along_path(SurfacePoint at, Vertex vertex, std::mt19937_64& numbers) const;
    [[nodiscard]] Vec3 from_emitter(const SurfacePoint& at,
                                    const std::array<double, 3>& numbers) const;
    /// Density per area with which a point of a side that emits is drawn.
    [[nodiscard]] double density(const Patch& side) const;

    const Mesh& mesh_;
    const Tracer& tracer_;
    std::vector<Patch> emitters_;
    std::vector<double> power_sums_;
};

} // namespace hemilux::bench
