#pragma once
// Rays that are listed are drawn: where on their patch they start, and where they go.

#include "bvh/tracer.h"
#include "geometry/frame.h"
#include "geometry/polygon_sampler.h"
#include "radiosity/rng.h"
#include "radiosity/strategy.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;

/// Rays from a patch into one of its cells.
struct Burst {
    std::uint32_t patch;
    std::uint16_t cell;
    std::uint32_t rays;
    /// Phi_ray / Phi_patch; until the rays are drawn Phi_ray / Phi_tr.
    double ray_power;
};

/// From where and into what.
struct RaySource {
    const Mesh& mesh;
    const Hemisphere& hemisphere;
    const Strategy& strategy;
    bool literal;
};

/// The rays of a list of bursts in their order, some at a time. The bursts of a patch follow each
/// other, and what is drawn for them depends on the seed, the patch and them, not on others.
class BurstRays {
  public:
    /// `memory` holds the rays between two calls and may be used again afterwards.
    BurstRays(const RaySource& source, std::span<Burst> bursts, std::uint64_t seed,
              std::vector<Ray>& memory);

    /// The next ones, rays_at_a_time until the last; none when there are no more.
    [[nodiscard]] std::span<const Ray> next();

  private:
    /// What all bursts of a patch have in common.
    struct From {
        std::uint32_t patch;
        PolygonSampler shape;
        Frame frame;
        Rng rng;
    };
    /// Where the rays of a burst start and where they go.
    struct Aim {
        std::optional<PolygonSampler> part; ///< where rays of a private cell start
        std::optional<Vec3> centre;         ///< all from there
        std::optional<SphericalTriangle> own;
        const SphericalTriangle* triangle = nullptr; ///< nullptr: the whole hemisphere
    };
    void begin(Burst& burst);
    void draw(std::span<Ray> rays);

    const RaySource& source_;
    std::span<Burst> bursts_;
    std::uint64_t seed_;
    std::vector<Ray>& rays_;
    std::uint32_t drawn_ = 0; ///< of the first of bursts_
    std::optional<From> from_;
    Aim aim_;
};

} // namespace hemilux
