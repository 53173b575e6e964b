#pragma once
// The light that arrives at points in two parts, for pictures, which filter them differently:
// straight from small emitters, with the sharp edges of shadows; and all other, which varies
// slowly.

#include "bvh/tracer.h"
#include "radiosity/final_gather/linear_light.h"
#include "radiosity/final_gather/reached_emitters.h"
#include "radiosity/final_gather/surface_points.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;

/// Random numbers of a point: `count` points of the Sobol sequence of a seed, `first` and those
/// after it.
struct GatherSamples {
    std::uint64_t seed;
    std::uint32_t first, count;
};

/// Light straight from small emitters [W/m2]. What varies from sample to sample varies in both
/// alike, but for shadows.
struct DirectLight {
    Vec3 arriving{0.0};
    Vec3 unshadowed{0.0}; ///< what would arrive if nothing stood between
    double nearness = 0;  ///< mean inverse distance of the emitters, by that light; local frame
};
enum class Shadows { traced, left_out };

struct IndirectLight {
    Vec3 irradiance{0.0}; ///< [W/m2]
    double nearness = 0;  ///< mean inverse distance of what the rays met; local frame
};

class GatherInParts {
  public:
    /// `light`: what patches send. All of it outlives this.
    GatherInParts(const Mesh& mesh, const Tracer& tracer, PatchLight light)
        : mesh_(mesh), tracer_(tracer), light_(light), emitters_(mesh) {}

    /// At each point by its own samples, on the calling thread: a shadow ray for each. Where
    /// shadows are left out no ray is traced, and nothing arrives.
    [[nodiscard]] std::vector<DirectLight> direct(std::span<const SurfacePoint> points,
                                                  std::span<const GatherSamples> samples,
                                                  Shadows shadows) const;
    /// In the same way by a cosine-distributed ray for each sample, which reads the patch that it
    /// meets, however near.
    [[nodiscard]] std::vector<IndirectLight> indirect(std::span<const SurfacePoint> points,
                                                      std::span<const GatherSamples> samples) const;

  private:
    struct Sample {
        std::uint32_t point;
        double share; ///< of what the ray meets
    };
    void read_patches(std::span<const Ray> rays, std::span<const Sample> samples,
                      std::span<IndirectLight> found) const;

    const Mesh& mesh_;
    const Tracer& tracer_;
    PatchLight light_;
    ReachedEmitters emitters_;
};

} // namespace hemilux
