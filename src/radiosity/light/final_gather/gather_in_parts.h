#pragma once
// The light that arrives at points in three parts, for pictures, which filter them differently. One
// comes straight from small emitters, with the sharp edges of shadows; one from lights without
// extent, which has no noise and is not filtered; the other is all other light, which varies
// slowly.

#include "bvh/tracer.h"
#include "radiosity/engine/emitters/reached_emitters.h"
#include "radiosity/light/cached_light/surface_light.h"
#include "radiosity/light/final_gather/bright_patches.h"
#include "radiosity/light/final_gather/gather_paths.h"
#include "radiosity/light/final_gather/surface_points.h"

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;

/// The random numbers of a point: `count` points of the Sobol sequence of a seed, from `first` on.
struct GatherSamples {
    std::uint64_t seed;
    std::uint32_t first, count;
    bool partly_aimed = false; ///< half of the indirect rays are aimed at bright patches
};

/// The light straight from small emitters [W/m2]. What varies from sample to sample varies in both
/// alike, except for shadows.
struct EmitterLight {
    Vec3 arriving{0.0};
    Vec3 unshadowed{0.0}; ///< what would arrive if nothing stood between
    double nearness = 0;  ///< mean inverse distance of the emitters, by that light; local frame
};
enum class Shadows { traced, left_out };

struct IndirectLight {
    Vec3 irradiance{0.0}; ///< [W/m2]
    double nearness = 0;  ///< mean inverse distance of what the rays met; local frame
    /// The sums over rays of the square of the light that they read, of all rays and of those that
    /// met bright patches. The nearer both are, the more noise random rays find there.
    double squares = 0, bright_squares = 0;
};

class GatherInParts {
  public:
    /// `light` is what surfaces send. With `only_reflected` nothing counts that arrives straight
    /// from where it is emitted.
    GatherInParts(const Mesh& mesh, const Tracer& tracer, const SurfaceLight& light,
                  bool only_reflected = false)
        : mesh_(mesh), tracer_(tracer), light_(light), emitters_(mesh),
          bright_(mesh, light.of_patches().radiosity, emitters_), paths_(mesh, tracer, light),
          only_reflected_(only_reflected) {}

    /// Returns the light of emitters at each point by its own samples, on the calling thread, with
    /// a shadow ray for each. If shadows are left out, no ray is traced, and nothing arrives.
    [[nodiscard]] std::vector<EmitterLight> direct(std::span<const SurfacePoint> points,
                                                   std::span<const GatherSamples> samples,
                                                   Shadows shadows) const;
    /// Returns the light of lights without extent at each point [W/m2], by shadow rays.
    [[nodiscard]] std::vector<Vec3> from_points(std::span<const SurfacePoint> points,
                                                std::span<const GatherSamples> samples) const;
    /// Returns the other light in the same way as direct(), by a cosine-distributed ray for each
    /// sample. It reads the light that it meets, or goes on where that is too near. Half of the
    /// samples may be rays to bright patches instead (bright_patches.h).
    [[nodiscard]] std::vector<IndirectLight> indirect(std::span<const SurfacePoint> points,
                                                      std::span<const GatherSamples> samples) const;

    /// Returns the rays so far, but for those of paths that go on.
    [[nodiscard]] std::uint64_t rays() const { return traced_; }

  private:
    /// The rays that are not traced yet. Aimed ones belong to points that share chances.
    struct Rays {
        struct Sample {
            std::uint32_t point;
            unsigned at_random;   ///< rays of this point
            std::uint32_t target; ///< the patch that it is aimed at, or none
        };
        std::vector<Ray> rays;
        std::vector<Sample> samples;
        unsigned aimed = 0;     ///< rays of each point
        std::uint64_t seed = 0; ///< of the paths that go on
        BrightPatches::Aim aim;
    };
    void read_patches(std::span<const SurfacePoint> points, const Rays& rays,
                      std::span<IndirectLight> found) const;

    const Mesh& mesh_;
    const Tracer& tracer_;
    SurfaceLight light_;
    ReachedEmitters emitters_;
    BrightPatches bright_;
    GatherPaths paths_;
    bool only_reflected_;
    mutable std::atomic<std::uint64_t> traced_{0};
};

} // namespace hemilux
