#pragma once
// The light that arrives at points, gathered once more from a solution on patches.
//
// A patch holds one value for its whole area; a point sees more: the edge of a shadow, the light of
// a lamp that is near. So the light straight from small emitters is found by shadow rays with their
// exact factor, and all other light by cosine-distributed rays that read the solution where they
// strike (final gather: Reichert 1992; Lischinski, Tampieri and Greenberg 1993, "local pass").

#include "geometry/polygon_sampler.h"
#include "radiosity/final_gather/surface_points.h"
#include "radiosity/gathering/emitter_choice.h"
#include "radiosity/scene/mesh.h"

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class StopFlag;
class Tracer;
class Workers;

class FinalGather {
  public:
    /// Rays of one estimate at one point: 16 cosine-distributed ones and up to 4 shadow rays.
    static constexpr unsigned random_rays = 16, shadow_rays = 4;

    /// `radiosity`: by patch [W/m2]. All of it outlives this.
    FinalGather(const Mesh& mesh, const Tracer& tracer, std::span<const Vec3> radiosity);

    /// `estimates` of the irradiance at each point [W/m2], independent of each other and without
    /// bias for the light that the solution sends: those of point k stand from k * estimates on.
    /// `streams`: of random numbers, one for each point; where points share theirs, their errors
    /// are much alike. Where it was interrupted meanwhile the rest is 0.
    [[nodiscard]] std::vector<Vec3> irradiance(std::span<const SurfacePoint> points,
                                               std::span<const std::uint64_t> streams,
                                               std::size_t estimates, const Workers& workers,
                                               const StopFlag& interrupted);
    /// Traced so far.
    [[nodiscard]] std::uint64_t rays() const { return rays_; }

  private:
    FinalGather(const Mesh& mesh, const Tracer& tracer, std::span<const Vec3> radiosity,
                const std::vector<std::uint32_t>& emitters);

    struct Emitter {
        Patch side; ///< of a whole facet
        PolygonSampler points;
        double near; ///< from the centre, see look_at
    };
    struct Batch;
    void gather(const SurfacePoint& point, std::uint64_t seed, std::size_t estimates,
                std::uint32_t place, Batch& batch) const;
    void send(Batch& batch, std::span<Vec3> found);

    const Mesh& mesh_;
    const Tracer& tracer_;
    std::span<const Vec3> radiosity_;
    std::vector<Vec3> without_emitters_; ///< the same less what the emitters below emit
    std::vector<Patch> sides_;
    std::vector<Emitter> emitters_; ///< those reached by shadow rays
    EmitterChoice choice_;
    std::atomic<std::uint64_t> rays_{0};
};

} // namespace hemilux
