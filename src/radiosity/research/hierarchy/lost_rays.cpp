#include "radiosity/research/hierarchy/lost_rays.h"

#include "geometry/elementary.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/solution/missed_light.h"

#include <algorithm>
#include <cmath>

namespace hemilux {
namespace {

/// Returns the variance of a patch's sum between the batches.
double variance_of_sum(std::span<const std::vector<double>> sums, std::size_t patch) {
    const auto n = static_cast<double>(sums.size());
    double mean = 0, squares = 0;
    for (const std::vector<double>& sum : sums)
        mean += sum[patch] / n;
    for (const std::vector<double>& sum : sums)
        squares += (sum[patch] - mean) * (sum[patch] - mean);
    return squares / (n - 1);
}

/// Returns the share of the sums in the mean of both, by patch, each weighted by the inverse of its
/// variance over all batches. It is 0 if no ray of any patch was lost.
std::vector<double> weights_of_sums(const LostRays& rays,
                                    std::span<const std::vector<double>> sums) {
    const std::size_t batches = rays.batches();
    const std::span<const double> rays_of_batch = rays.rays_of_batch();
    std::vector<double> lost(rays.patches()), weight(rays.patches());
    double all_lost = 0, all_rays = 0;
    for (std::size_t i = 0; i < lost.size(); ++i) {
        for (std::size_t r = 0; r < batches; ++r)
            lost[i] += rays.lost(r, i).sum() / double(batches);
        all_lost += lost[i] * rays_of_batch[i];
        all_rays += rays_of_batch[i];
    }
    if (!(all_lost > 0))
        return weight;
    const double prior = (all_lost + 1) / (all_rays + 2); // not all: a far emitter is met by none
    for (std::size_t i = 0; i < lost.size(); ++i) {
        const double all = rays_of_batch[i] * double(batches);
        const double share = (all * lost[i] + prior) / (all + 1);
        const double of_loss = share * (1 - share) / rays_of_batch[i];
        const double of_sum = variance_of_sum(sums, i);
        weight[i] = of_sum + of_loss > 0 ? of_loss / (of_sum + of_loss) : 0;
    }
    return weight;
}

} // namespace

LostRays::LostRays(const Mesh& mesh, const Tracer& tracer, std::uint64_t seed,
                   std::size_t batches) {
    for (std::uint64_t r = 0; r < batches; ++r)
        batches_.emplace_back(mesh, tracer, hash_words({seed, r, 0x6c6f7373u}));
    rays_.resize(batches_.front().patches());
}

std::uint64_t LostRays::trace_up_to(double rays, std::span<const Vec3> emission,
                                    const Workers& workers, Monitor& monitor) {
    constexpr double for_emitters = 8;
    std::vector<std::uint32_t> wanted;
    for (const Vec3& of_patch : emission) {
        const double times = of_patch == Vec3(0.0) ? 1 : for_emitters;
        wanted.push_back(
            static_cast<std::uint32_t>(std::max(std::ceil(times * rays / double(batches())), 1.0)));
    }
    const std::uint64_t traced = RayCounts::trace_up_to(batches_, wanted, workers, monitor, .5);
    for (std::uint32_t i = 0; i < rays_.size(); ++i)
        rays_[i] = batches_.front().rays(i);
    return traced;
}

EscapeFraction LostRays::lost(std::size_t batch, std::size_t patch) const {
    const auto i = static_cast<std::uint32_t>(patch);
    if (!(rays_[i] > 0))
        return {};
    return {batches_[batch].escaped(i) / rays_[i], batches_[batch].absorbed(i) / rays_[i]};
}

double LostRays::prior_escape() const {
    double leaving = 0, all = 0;
    for (const RayCounts& batch : batches_)
        for (std::uint32_t i = 0; i < patches(); ++i) {
            leaving += batch.escaped(i);
            all += double(batch.escaped(i)) + double(batch.absorbed(i));
        }
    return all > 0 ? leaving / all : 1;
}

double LostRays::uncertain_light(std::span<const double> area, std::span<const Vec3> radiosity,
                                 std::span<const Vec3> emission) const {
    const auto n = static_cast<double>(batches());
    double leaving = 0, emitted = 0, all_rays = 0, variance = 0;
    for (std::uint32_t i = 0; i < patches(); ++i) {
        const double power = area[i] * mean_of_channels(radiosity[i]);
        if (!(power > 0))
            continue;
        double lost = 0;
        for (const RayCounts& batch : batches_)
            lost += double(batch.escaped(i)) + double(batch.absorbed(i));
        const double rays = rays_[i] * n, of_batch = std::min(lost, rays - lost) / n;
        variance += power * power / (rays * rays) * n * std::min(of_batch, std::sqrt(of_batch));
        leaving += power;
        emitted += area[i] * mean_of_channels(emission[i]);
        all_rays += rays;
    }
    if (!(emitted > 0) || !(all_rays > 0))
        return 0;
    return elementary::hypot(rule_of_three * leaving / all_rays, std::sqrt(variance)) / emitted;
}

std::vector<NormalisedRows> normalise_rows(const LostRays& lost,
                                           std::span<const std::vector<double>> sums) {
    const std::vector<double> weight = weights_of_sums(lost, sums);
    const double prior = lost.prior_escape();
    std::vector<NormalisedRows> batches(sums.size());
    for (std::size_t r = 0; r < batches.size(); ++r)
        for (std::size_t i = 0; i < weight.size(); ++i) {
            const EscapeFraction by_rays = lost.lost(r, i);
            const double share = by_rays.sum(), sum = sums[r][i];
            const double due = std::clamp(std::lerp(1 - share, sum, weight[i]), 0.0, 1.0);
            const double escaping = share > 0 ? by_rays.escaped / share : prior;
            batches[r].self.push_back(due - sum);
            batches[r].lost.push_back({(1 - due) * escaping, (1 - due) * (1 - escaping)});
        }
    return batches;
}

} // namespace hemilux
