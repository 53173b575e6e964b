#pragma once
// Finds where light goes, as a quick look at a scene needs it. It traces a few thousand paths from
// the emitters, facet by facet and not patch by patch.

#include "bvh/tracer.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"

#include <array>
#include <vector>

namespace hemilux {

/// One side of a facet, from which a ray leaves.
struct FacetSide {
    std::uint32_t facet;
    bool back;
};

/// Returns a ray from a random point of a side, by the cosine law. It starts a little off the
/// plane, so that layers that lie in one place (coplanar_layers.h) do not hide each other.
[[nodiscard]] Ray diffuse_ray(const Mesh& mesh, FacetSide side, Rng& rng);

/// The random points of all facets that do not shine, uniform by area. Rays towards them find the
/// ground below a sun, which hardly any ray by the cosine law does.
class Targets {
  public:
    /// Sums the areas of the facets.
    explicit Targets(const Mesh& mesh);
    /// Returns a ray from a random point of a side to a random target; empty where the target is
    /// behind the side.
    [[nodiscard]] std::optional<Ray> ray_from(FacetSide side, Rng& rng) const;

  private:
    const Mesh& mesh_;
    std::vector<double> area_sums_; ///< running sums by facet, local units
};

/// Returns the power that a facet emits on one side, all channels together [W/m2 times area in the
/// local frame]. It is 0 where that is not finite. It is also 0 for a sun or sky: its light comes
/// from all sides, whichever of them a surface is to be seen from.
[[nodiscard]] double power_of(const Mesh& mesh, std::uint32_t facet);

/// Returns how many of about `count` items each facet gets, in proportion to its weight. The
/// sampling is systematic, so each has its share to within one.
[[nodiscard]] std::vector<std::uint32_t> shares_of(const std::vector<double>& weights,
                                                   std::uint32_t count);

/// The light that arrives on the front and on the back of a facet, as the scene has them [rays of
/// equal power].
using SideLight = std::array<double, 2>;

/// Returns the light on each facet if all facets reflected half of it on both sides. This estimate
/// does not depend on which side is the front. `shines_back` says, by facet, whether an emitting
/// one shines to its back.
[[nodiscard]] std::vector<SideLight> light_on_sides(const Mesh& mesh, const Tracer& tracer,
                                                    const Targets& targets,
                                                    const std::vector<bool>& shines_back);

/// The shares of the emitted light [-], all channels together; the rest is absorbed by fronts. They
/// are 0 where nothing emits.
struct LightShares {
    double backs = 0;   ///< falls on backs of one-sided faces, which absorb it
    double escaped = 0; ///< leaves the scene
};

/// Finds the shares from 1024 paths, so the standard error of a share is at most 1.6 %. The same
/// mesh gives the same shares.
[[nodiscard]] LightShares find_light_shares(const Mesh& mesh, const Tracer& tracer);

} // namespace hemilux
