#include "radiosity/engine/linear/emitter_losses.h"

#include <algorithm>

namespace hemilux {
namespace {

/// An exact share counts as if so many times the emitter's rays had found it.
constexpr double max_rays_more = 1000;

/// Both estimates of the share that one emitter loses.
struct TwoAccounts {
    std::vector<double> by_rays, by_factors; ///< escape fraction, by batch
    double sum_by_rays = 0;

    TwoAccounts(std::span<const SampledFormFactors> batches, std::size_t emitter) {
        for (const SampledFormFactors& factors : batches) {
            by_rays.push_back(factors.lost()[factors.emitters()[emitter]].sum());
            sum_by_rays += by_rays.back();
            by_factors.push_back(1 - factors.arriving_from(emitter));
        }
    }

    /// Returns the variance of a share by `rays` rays, as if all batches together had one more that
    /// was lost.
    [[nodiscard]] double variance_by_rays(double rays) const {
        const double all = rays * double(by_rays.size());
        const double prior = (rays * sum_by_rays + 1) / (all + 2);
        return prior * (1 - prior) / rays;
    }
    [[nodiscard]] double variance_by_factors() const {
        const double n = double(by_factors.size());
        double mean = 0, squares = 0;
        for (const double share : by_factors)
            mean += share / n;
        for (const double share : by_factors)
            squares += (share - mean) * (share - mean);
        return squares / (n - 1);
    }
};

/// Sums the escape fractions of the rays of all emitters.
EscapeFraction kinds_of_loss(std::span<const SampledFormFactors> batches) {
    EscapeFraction kinds;
    for (const SampledFormFactors& factors : batches)
        for (const std::uint32_t emitter : factors.emitters()) {
            kinds.escaped += factors.lost()[emitter].escaped;
            kinds.absorbed += factors.lost()[emitter].absorbed;
        }
    return kinds;
}

} // namespace

std::vector<std::vector<EmitterLoss>> emitter_losses(std::span<const SampledFormFactors> batches,
                                                     double rays) {
    std::vector<std::vector<EmitterLoss>> losses(batches.size());
    const EscapeFraction kinds = kinds_of_loss(batches);
    const double sum = kinds.sum();
    if (!batches.front().all_receive() || !(sum > 0))
        return losses;
    for (std::size_t e = 0; e < batches.front().emitters().size(); ++e) {
        const TwoAccounts accounts(batches, e);
        const double of_rays = accounts.variance_by_rays(rays);
        const double weight = of_rays / (of_rays + accounts.variance_by_factors()); // of factors
        const double more = std::min(1 / (1 - weight), max_rays_more);
        const double escaping = kinds.escaped / sum;
        for (std::size_t r = 0; r < batches.size(); ++r) {
            const double share = std::clamp(
                weight * accounts.by_factors[r] + (1 - weight) * accounts.by_rays[r], 0.0, 1.0);
            losses[r].push_back({{share * escaping, share * (1 - escaping)}, rays * more});
        }
    }
    return losses;
}

} // namespace hemilux
