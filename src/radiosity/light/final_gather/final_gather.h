#pragma once
// The light that arrives at points, gathered once more from a solution on patches.
//
// A patch holds one value for its whole area; a point sees more: the edge of a shadow, the light of
// an emitter that is near. So the light straight from small emitters is found by shadow rays with
// their exact factor (reached_emitters.h), and that of lights without extent by a ray to each
// (point_emitters.h). All other light is found by cosine-distributed rays that
// read the solution where they strike (final gather: Reichert 1992; Lischinski, Tampieri and
// Greenberg 1993, "local pass"), or go on where it is too near (gather_paths.h).

#include "radiosity/light/final_gather/gather_paths.h"
#include "radiosity/light/final_gather/surface_points.h"

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class StopFlag;
class Workers;

class FinalGather {
  public:
    /// The rays of one round: cosine-distributed ones, and up to so many shadow rays.
    static constexpr unsigned usual_random_rays = 16, usual_shadow_rays = 4;

    /// `light` is what surfaces send.
    FinalGather(const Mesh& mesh, const Tracer& tracer, const SurfaceLight& light,
                unsigned random_rays = usual_random_rays, unsigned shadow_rays = usual_shadow_rays)
        : paths_(mesh, tracer, light), random_rays_(random_rays), shadow_rays_(shadow_rays) {}
    /// Gathers what patches send.
    FinalGather(const Mesh& mesh, const Tracer& tracer, PatchLight light,
                unsigned random_rays = usual_random_rays, unsigned shadow_rays = usual_shadow_rays)
        : FinalGather(mesh, tracer, SurfaceLight(mesh, light), random_rays, shadow_rays) {}

    /// Returns `estimates` of the irradiance at each point [W/m2], independent of each other and
    /// without bias for the light that the solution sends. Those of point k stand from k *
    /// estimates on. `streams` are those of random numbers, one for each point; if points share
    /// theirs, their errors are much alike. If it was interrupted meanwhile, the rest is 0. Ranks
    /// that share the flag all call this, and each traces the rays of some points.
    [[nodiscard]] std::vector<Vec3> irradiance(std::span<const SurfacePoint> points,
                                               std::span<const std::uint64_t> streams,
                                               std::size_t estimates, const Workers& workers,
                                               const StopFlag& interrupted);
    /// Sets the number of rounds of which an estimate is the mean, 1 at first. Their points are
    /// those of one sequence, so that more rounds reduce the error faster than independent
    /// estimates would.
    void set_rounds(unsigned rounds) { rounds_ = rounds; }
    /// Leaves out what arrives straight from where it is emitted.
    void set_only_reflected(bool only) { only_reflected_ = only; }
    /// Returns the number of rays traced so far.
    [[nodiscard]] std::uint64_t rays() const { return rays_; }

  private:
    void add_rays(const SurfacePoint& point, std::uint64_t seed, std::size_t estimates,
                  std::uint32_t place, PathRays& rays) const;

    GatherPaths paths_;
    unsigned random_rays_, shadow_rays_;
    unsigned rounds_ = 1;
    bool only_reflected_ = false;
    std::atomic<std::uint64_t> rays_{0};
};

/// The points over the surfaces, and independent estimates of the irradiance at each, in order.
struct GatheredAtPoints {
    std::vector<PatchPoint> points;
    std::vector<Vec3> irradiance; ///< [W/m2]
};
[[nodiscard]] GatheredAtPoints gather_over(const PointsOverSurface& surface, FinalGather& gather,
                                           std::size_t points, std::size_t estimates,
                                           std::uint64_t seed, const Workers& workers,
                                           const StopFlag& interrupted);

} // namespace hemilux
