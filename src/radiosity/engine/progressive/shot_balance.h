#pragma once
// The balance of a shot of progressive radiosity: where its light goes.
//
// Two things estimate what share of the light arrives at patches: the sum of the form factors, and
// rays from the shooter, some of which are lost. Neither is exact. Both are weighted by the inverse
// of their variances, the factors are scaled to the result, and the rest is lost. So no energy is
// made between patches, which in bright rooms would be made again in each bounce. Where much
// depends on pairs that are looked at by chance, factors are left as they are, right on average.

#include "radiosity/engine/factors/rows/escape_fraction.h"

#include <cstdint>

namespace hemilux {

class Mesh;
class Tracer;
struct Needs;

/// The numbers of rays from the shooter, and of those that met no patch that was looked from.
struct ShotRays {
    double count = 0, escaped = 0, absorbed = 0;
};

/// Shoots `count` cosine-distributed rays from the whole shooter. Rays that hit patches without
/// power count as absorbed.
[[nodiscard]] ShotRays shoot_to_lose(const Mesh& mesh, const Tracer& tracer, const Needs& needs,
                                     std::uint32_t shooter, std::uint32_t count,
                                     std::uint64_t seed);

/// The sum of all factors from receivers to the shooter, times the ratio of their areas [-]: the
/// share of the shot that arrives.
struct FactorSum {
    double sum = 0, variance = 0;
    double at_risk = 0; ///< estimated sum of those that were looked at by chance only
    double points = 0;  ///< points of receivers from which it was looked
};

/// The shares of the power of a shot, by where they go [-].
struct ShotShares {
    double scale = 1;     ///< factor of all factors
    EscapeFraction lost;  ///< what falls elsewhere
    double by_chance = 0; ///< what was neither received nor lost, on average 0
    bool scaled = false;  ///< whether the factors were made to sum up to what arrives
    double variance = 0;  ///< variance of what arrives, relative: an error of all factors
};

class ShotBalance {
  public:
    /// With `closed`, no light can be lost, as the geometry proves.
    explicit ShotBalance(bool closed) : closed_(closed) {}
    ShotShares balance(const FactorSum& factors, const ShotRays& rays);

  private:
    [[nodiscard]] double variance_of_loss(double count) const;
    [[nodiscard]] double prior_variance(const FactorSum& factors) const;

    bool closed_;
    ShotRays all_; ///< rays of all shots: where hardly any is lost, a few do not show it
    double shots_ = 0, spread_of_point_ = 0; ///< the latter summed over all shots
};

} // namespace hemilux
