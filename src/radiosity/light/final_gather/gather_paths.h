#pragma once
// The paths that follow from the rays of a gather. A ray reads the light of the patch that it
// meets. A near patch may not send there what it sends on average, as in corners and in gaps. The
// ray then goes on as a path (Christensen 1999): it gathers the light that is reflected there too.

#include "bvh/tracer.h"
#include "radiosity/engine/emitters/point_emitters.h"
#include "radiosity/engine/emitters/reached_emitters.h"
#include "radiosity/light/cached_light/surface_light.h"
#include "radiosity/light/final_gather/surface_points.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;

/// The random rays that are not traced yet, and shadow rays from the same points.
struct PathRays {
    /// This is what a random ray carries.
    struct State {
        std::uint64_t seed;          ///< of what follows from it
        std::uint32_t place;         ///< of the estimate
        Vec3 share;                  ///< of what it meets, that counts in the estimate
        bool sees_emission = true;   ///< emitters are left to it
        bool only_reflected = false; ///< what is emitted where it ends does not count
    };
    std::vector<Ray> random;
    std::vector<State> states; ///< of each ray at random
    ShadowRays<LightAtPlace> shadow;
    WeighedEmitters weighed; ///< for the point that rays were added at last

    void add(const Ray& ray, const State& state) {
        random.push_back(ray);
        states.push_back(state);
    }
};

class GatherPaths {
  public:
    /// `light` is what surfaces send.
    GatherPaths(const Mesh& mesh, const Tracer& tracer, const SurfaceLight& light)
        : mesh_(mesh), tracer_(tracer), light_(light), emitters_(mesh), points_(mesh) {}

    [[nodiscard]] const ReachedEmitters& emitters() const { return emitters_; }
    /// Returns the lights without extent.
    [[nodiscard]] const PointEmitters& points() const { return points_; }

    /// Adds rays for the light that arrives at a point, where a path begins; `state.share` of it
    /// counts.
    void begin_at(const SurfacePoint& at, const PathRays::State& state, PathRays& rays) const {
        emitters_.weigh(at, rays.weighed);
        add_rays(at, state, rays);
    }

    /// Adds what the rays and their paths find, at their places of `found` [W/m2]. Returns the
    /// number of all rays.
    std::uint64_t trace(PathRays rays, std::span<Vec3> found) const;

  private:
    /// This is what a random ray meets.
    struct Met {
        std::size_t ray; ///< among the rays
        std::uint32_t patch;
        Vec3 point;      ///< local frame
        double distance; ///< local frame
        Colours here = {};
        SurfaceLight::Irradiance arriving = {};
    };
    /// Returns whether a gather takes the light of a patch that is met from so near as a path.
    [[nodiscard]] bool is_near(const Met& met, unsigned bounce) const;
    [[nodiscard]] Met where_met(const PathRays& rays, std::size_t k, std::uint32_t patch) const;
    /// Adds what is found where a ray ends. Returns whether its path goes on.
    bool end_ray(const PathRays::State& ray, const Met& met, unsigned bounce,
                 std::span<Vec3> found) const;
    void go_on(const PathRays::State& from, const Met& met, PathRays& next) const;
    void add_rays(const SurfacePoint& at, const PathRays::State& state, PathRays& next) const;

    const Mesh& mesh_;
    const Tracer& tracer_;
    SurfaceLight light_;
    ReachedEmitters emitters_;
    PointEmitters points_;
};

} // namespace hemilux
