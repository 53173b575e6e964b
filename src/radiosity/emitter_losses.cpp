#include "radiosity/emitter_losses.h"

#include <algorithm>

namespace hemilux {
namespace {

/// An exact share counts as if so many times the emitter's rays had told it.
constexpr double most_rays_more = 1000;

/// Of one emitter.
struct TwoAccounts {
    std::vector<double> by_rays, by_factors; ///< lost share, by replicate
    LostShare kinds;                         ///< sums of the rays' shares

    TwoAccounts(std::span<const SampledFormFactors> replicates, std::size_t emitter) {
        for (const SampledFormFactors& factors : replicates) {
            const LostShare lost = factors.lost(factors.emitters()[emitter]);
            kinds.escaped += lost.escaped;
            kinds.absorbed += lost.absorbed;
            by_rays.push_back(lost.escaped + lost.absorbed);
            by_factors.push_back(1 - factors.arriving_from(emitter));
        }
    }

    /// Of a share by `rays` rays, as if all replicates together had one more that was lost.
    [[nodiscard]] double variance_by_rays(double rays) const {
        const double all = rays * double(by_rays.size());
        const double usual = (rays * (kinds.escaped + kinds.absorbed) + 1) / (all + 2);
        return usual * (1 - usual) / rays;
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

} // namespace

std::vector<std::vector<EmitterLoss>> emitter_losses(std::span<const SampledFormFactors> replicates,
                                                     double rays) {
    std::vector<std::vector<EmitterLoss>> losses(replicates.size());
    for (std::size_t e = 0; e < replicates.front().emitters().size(); ++e) {
        const TwoAccounts accounts(replicates, e);
        const double of_rays = accounts.variance_by_rays(rays);
        const double of_factors = accounts.variance_by_factors();
        const bool known = replicates.front().all_look();
        const double weight = known ? of_rays / (of_rays + of_factors) : 0; // of the factors
        const double sum = accounts.kinds.escaped + accounts.kinds.absorbed;
        const double more = std::min(1 / std::max(1 - weight, 1 / most_rays_more), most_rays_more);
        for (std::size_t r = 0; r < replicates.size(); ++r) {
            const double share = std::clamp(
                weight * accounts.by_factors[r] + (1 - weight) * accounts.by_rays[r], 0.0, 1.0);
            const double escaping = sum > 0 ? accounts.kinds.escaped / sum : 1;
            losses[r].push_back({{share * escaping, share * (1 - escaping)}, rays * more});
        }
    }
    return losses;
}

} // namespace hemilux
