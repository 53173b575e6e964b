#include "radiosity/engine/progressive/shot_balance.h"

#include "bvh/tracer.h"
#include "radiosity/engine/rays/receivers.h"
#include "radiosity/engine/sampling/sobol.h"
#include "radiosity/paper/rays/patch_start.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/scene/needs.h"

#include <algorithm>
#include <cmath>

namespace hemilux {
namespace {

/// Where more than this share is left to chance, factors are not scaled, as they would not be right
/// on average. What was found must not decide it, for the same reason.
constexpr double max_at_risk = .05;

} // namespace

ShotRays shoot_to_lose(const Mesh& mesh, const Tracer& tracer, const Needs& needs,
                       std::uint32_t shooter, std::uint32_t count, std::uint64_t seed) {
    const auto start = PatchStart::in_any_axes(mesh, shooter);
    std::vector<Ray> rays;
    SobolBlocks<4> points(seed);
    for (std::uint32_t k = 0; k < count; ++k) {
        const auto u = points.at(k);
        rays.push_back(start.ray({u[0], u[1]}, cosine_direction({u[2], u[3]})));
    }
    std::vector<std::uint32_t> receivers;
    find_receivers(rays, mesh, tracer, receivers);
    ShotRays result{double(count), 0, 0};
    for (const std::uint32_t receiver : receivers)
        if (receiver == escaped)
            ++result.escaped;
        else if (receiver == absorbed || !needs.power(receiver))
            ++result.absorbed;
    return result;
}

/// Returns the variance of the share of rays that are lost, if as many are lost as of the rays of
/// all shots, and one more. A variance by what the few rays of this shot have met would trust those
/// most that happened to lose none.
double ShotBalance::variance_of_loss(double count) const {
    const double prior = (all_.escaped + all_.absorbed + 1) / (all_.count + 2);
    return prior * (1 - prior) / count;
}

/// Returns the variance of the sum of factors whose points scatter as those of all shots, for the
/// same reason. Where by chance little was seen, little was seen to scatter; the sum of the factors
/// would be trusted most when it is too small.
double ShotBalance::prior_variance(const FactorSum& factors) const {
    const double spread = spread_of_point_ / shots_; // not its square: few shots would outweigh all
    return factors.points > 0 ? spread * spread / factors.points : factors.variance;
}

ShotShares ShotBalance::balance(const FactorSum& factors, const ShotRays& rays) {
    const double sum = factors.sum;
    ++shots_;
    spread_of_point_ += std::sqrt(factors.variance * factors.points);
    all_.count += rays.count;
    all_.escaped += rays.escaped;
    all_.absorbed += rays.absorbed;
    const double lost = (rays.escaped + rays.absorbed) / rays.count;
    if (!(sum > 0) || factors.at_risk > max_at_risk)
        return {.scale = 1,
                .lost = {rays.escaped / rays.count, rays.absorbed / rays.count},
                .by_chance = 1 - sum - lost};
    if (closed_)
        return {1 / sum, {}, 0, true, 0};
    const double variance_of_rays = variance_of_loss(rays.count);
    const double of_sum = prior_variance(factors), both = of_sum + variance_of_rays;
    const double trust = both > 0 ? of_sum / both : 1; // in the rays
    const double joined = trust * (1 - lost) + (1 - trust) * sum;
    const double of_joined =
        trust * trust * variance_of_rays + (1 - trust) * (1 - trust) * factors.variance;
    const double relative = joined > 0 ? of_joined / (joined * joined) : 0;
    const EscapeFraction kinds{rays.escaped + all_.escaped / all_.count,
                               rays.absorbed + all_.absorbed / all_.count};
    const double known = kinds.sum();
    // A share above 1 is due to chance, and evens out: cut off, light would be missing on average.
    if (!(known > 0) || joined >= 1)
        return {joined / sum, {}, 1 - joined, true, relative};
    const double each = (1 - joined) / known;
    return {joined / sum, {each * kinds.escaped, each * kinds.absorbed}, 0, true, relative};
}

} // namespace hemilux
