#pragma once
// The lights without extent of a mesh, and shadow rays to them.
//
// Such a light cannot be met by a random ray. A shadow ray to it brings I cos / r^2, without noise.
// A point takes a ray to each light that shines at it, or, if these are too many, as many rays as
// it may, by systematic sampling (Madow and Madow 1944): the light of all is laid end to end, as if
// nothing stood between, and a comb with one random offset picks the lights. So what varies from
// comb to comb is only what is hidden.

#include "geometry/vector.h"
#include "radiosity/engine/emitters/reached_emitters.h"
#include "radiosity/engine/rays/point_emitter.h"
#include "radiosity/engine/rays/shadow_rays.h"
#include "radiosity/engine/rays/surface_point.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace hemilux {

class Mesh;

/// A surface so near to a light does not hide it [local units]: a light may lie on a ceiling, whose
/// corners are rounded. The local frame is 2 wide.
inline constexpr double near_light = 1e-6;

class PointEmitters {
  public:
    explicit PointEmitters(const Mesh& mesh);

    [[nodiscard]] bool empty() const { return emitters_.empty(); }
    [[nodiscard]] std::size_t count() const { return emitters_.size(); }
    /// Returns a light in the local frame: its intensity is in W/m2 times local units squared.
    [[nodiscard]] const PointEmitter& operator[](std::size_t k) const { return emitters_[k]; }

    /// Returns the light of all channels [-], each relative to the strongest light in it: faint
    /// channels count as much as bright ones where rays are allocated.
    [[nodiscard]] double balanced(const Vec3& light) const { return glm::dot(light, balance_); }

    /// What a light brings to a point if nothing stands between.
    struct Arriving {
        Ray ray;
        Vec3 irradiance; ///< [W/m2]
    };
    /// Returns nothing if the light does not shine at the front of the point.
    [[nodiscard]] std::optional<Arriving> at(std::size_t k, const SurfacePoint& point) const;

    /// The number of rays up to which a point where light is asked for takes one to each light.
    /// More are as right on average, and take longer.
    static constexpr std::size_t max_rays_of_point = 64;

    /// Adds at most so many rays for the light of all at a point, whose sum is right on average
    /// over `u`, uniform in [0,1). `share` of the light counts.
    void add_rays(const SurfacePoint& point, std::size_t max_rays, double u, const Vec3& share,
                  std::uint32_t place, ShadowRays<LightAtPlace>& rays) const;

  private:
    std::vector<PointEmitter> emitters_;
    Vec3 balance_{0.0};
};

/// The power of all lights without extent [W/m2 times area in the local frame], and what of it
/// meets no front of a face.
struct PowerOfPoints {
    Vec3 sent{0.0};
    Vec3 escaped{0.0};     ///< leaves the scene
    Vec3 left_behind{0.0}; ///< falls on backs of one-sided faces
};
/// Finds them by rays from the lights, the same each time.
[[nodiscard]] PowerOfPoints power_of_points(const Mesh& mesh, const Tracer& tracer);

} // namespace hemilux
