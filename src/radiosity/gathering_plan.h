#pragma once
// How many rays gathering is to trace next, of which kind, and from which patches.

#include "radiosity/exchange_matrix.h"
#include "radiosity/needs.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;

/// Rays of each patch.
struct GatheringRays {
    std::vector<std::uint32_t> random;   ///< cosine-distributed
    std::vector<std::uint32_t> to_lamps; ///< shadow rays
};

class GatheringPlan {
  public:
    /// The first step's means, of one set; no `to_lamps`: there are no lamps to be reached.
    GatheringPlan(const Mesh& mesh, const Needs& needs, double random, double to_lamps);

    /// Plans more rays than before. `variance`: of the solution so far, and the part of it that
    /// comes from the light of lamps; not used for the first step.
    void grow(double variance, double variance_of_lamps);
    /// As before the last growth.
    void shrink_back() { now_ = before_; }

    /// In all until the next step ends.
    [[nodiscard]] const GatheringRays& rays() const { return now_.rays; }
    /// By the last growth, of random rays; 1 for the first.
    [[nodiscard]] double growth() const;
    [[nodiscard]] bool at_most() const;
    /// Whether there are patches that rays at random alone look from, where there are lamps.
    [[nodiscard]] bool some_without_shadow_rays() const { return some_without_; }

    /// From now on more to patches to which light comes that is uneven. `light` leaves patches for
    /// random rays to find [W/m2].
    void weigh(const ExchangeMatrix& factors, std::span<const Vec3> light, const Workers& workers);

  private:
    struct Stage {
        double random = 0, to_lamps = 0; ///< means
        GatheringRays rays;
    };
    void choose(double of_random, double of_lamps);

    Stage first_, before_, now_;
    std::vector<Vec3> reflectance_;
    std::vector<double> weights_, lamp_weights_; ///< what a ray is worth
    std::vector<double> prior_weights_;          ///< of random rays, before anything is known
    bool some_without_ = false;
};

} // namespace hemilux
