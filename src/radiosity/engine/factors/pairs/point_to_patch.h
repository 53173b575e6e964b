#pragma once
// Computes how much of its hemisphere a point of one patch gives to another patch. This is the
// kernel of form factors by shadow rays (Wallace, Elmquist and Haines 1989). It has Lambert's
// closed form of point and polygon in place of their disc.

#include "bvh/tracer.h"
#include "geometry/polygon_sampler.h"

#include <array>
#include <cstdint>
#include <limits>

namespace hemilux {

class Mesh;
struct Patch;

/// Returns the factor [-] of a ray. The mean over u in [0,1)^4, of the rays that nothing blocks, is
/// F_from,to. A factor of 0 means that the point does not face the patch. Near the target, the
/// factor is that from a random point to the whole patch, so that only shadows make it noisy. From
/// points further away from the target's centre than `near` [local units], it is that to a random
/// point of the patch. This is computed much sooner and almost as good where the target looks
/// small. Points come from samplers of both shapes. The ray ends short of the target; it is whole
/// if the factor is not 0.
[[nodiscard]] double look_at(const Patch& source, const PolygonSampler& origins,
                             const Patch& target, const PolygonSampler& targets,
                             const std::array<double, 4>& u, double near, Ray& ray);

/// Returns the same from a given point of a surface with a unit normal, and over u in [0,1)^2.
/// `facet` is the one that the point lies on, or none.
[[nodiscard]] double look_from(const Vec3& point, const Vec3& normal, std::uint32_t facet,
                               const Patch& target, const PolygonSampler& targets, Vec2 u,
                               double near, Ray& ray);

/// Points are near within so many radii of the target, from its centre; or from anywhere.
inline constexpr double near_radii = 4;
inline constexpr double everywhere = std::numeric_limits<double>::infinity();

/// A patch that looks at another one; each look traces one ray at most.
class PairLook {
  public:
    /// Prepares looks; `near` is as in look_at, and `visibility` is false where nothing can stand
    /// between two patches.
    PairLook(const Mesh& mesh, const Tracer& tracer, std::uint32_t from, std::uint32_t to,
             double near, bool visibility = true);

    /// Returns the factor [-] from a random point, or 0 if something stands between. Adds to `rays`
    /// if a ray had to be traced.
    [[nodiscard]] double factor(const std::array<double, 4>& u, std::uint64_t& rays) const;

  private:
    const Tracer& tracer_;
    const Patch &from_, &to_;
    PolygonSampler origins_, targets_;
    double near_; ///< distance as of look_at [local units]
    bool visibility_;
};

} // namespace hemilux
