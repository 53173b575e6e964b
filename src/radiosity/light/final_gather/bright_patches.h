#pragma once
// The brightest patches of a solution, at which gathers aim rays. What a hidden emitter lights
// first, as the ceiling above it, sends most of the light of a room from a small part of its
// surface. Few cosine-distributed rays find it.

#include "geometry/polygon_sampler.h"
#include "radiosity/engine/emitters/reached_emitters.h"
#include "radiosity/light/final_gather/surface_points.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class BrightPatches {
  public:
    /// Takes the patches that are brightest by their radiosity [W/m2] without what emitters send.
    /// They cover a sixteenth of all surfaces and are 4096 at most.
    BrightPatches(const Mesh& mesh, std::span<const Vec3> radiosity,
                  const ReachedEmitters& emitters);

    [[nodiscard]] bool contains(std::uint32_t patch) const { return number_[patch] != none; }

    /// The chances by which the rays of a point aim at each of them: in proportion to the light
    /// that would arrive if nothing stood between.
    struct Aim {
        std::vector<double> ends; ///< of each, the sum up to it
        [[nodiscard]] bool sees_any() const { return !ends.empty() && ends.back() > 0; }
    };
    void aim(const SurfacePoint& point, Aim& aim) const;

    struct Target {
        Vec3 direction; ///< unit
        std::uint32_t patch;
    };
    /// Returns the direction to a point uniform over the patch that u.x draws, for u uniform in
    /// [0,1)^3, from a point that sees any.
    [[nodiscard]] Target draw(const SurfacePoint& point, const Aim& aim, const Vec3& u) const;
    /// Returns the density of targets on a patch [1/sr], where a ray of this direction met it at
    /// distance t (local frame). It is 0 for other patches.
    [[nodiscard]] double density(const Aim& aim, std::uint32_t patch, double t,
                                 const Vec3& direction) const;

  private:
    struct Bright {
        std::uint32_t patch;
        double power; ///< area in local units times radiosity
        PolygonSampler points;
    };
    const Mesh& mesh_;
    std::vector<Bright> patches_;
    std::vector<std::uint32_t> number_; ///< by patch; none: not one of them
};

} // namespace hemilux
