#include "radiosity/ray_deal.h"

#include "radiosity/rng.h"

#include <algorithm>
#include <cmath>

namespace hemilux {
namespace {

constexpr double least_share = 1.0 / 8, most_share = 8;

/// The power of two nearest to a number, in logarithms.
std::uint32_t power_of_two(double rays) {
    return rays <= 1 ? 1 : std::uint32_t{1} << std::min(std::lround(std::log2(rays)), 31L);
}

/// From -1/2 to 1/2, another for each patch.
double dither(std::size_t patch) { return Rng(hash_words({patch})).uniform() - .5; }

/// To the nearest power of 2^(1/16) of the largest, so that rounding errors of areas decide
/// nothing; then up to half an octave up or down by the patch's number, which says who is first to
/// get more rays among patches of one shape.
std::vector<double> rounded(std::span<const double> weights, double largest) {
    std::vector<double> result;
    for (std::size_t i = 0; i < weights.size(); ++i)
        result.push_back(
            weights[i] > 0
                ? std::exp2(std::round(16 * std::log2(weights[i] / largest)) / 16 + dither(i))
                : 0);
    return result;
}

} // namespace

std::vector<std::uint32_t> deal_rays(std::span<const double> given, double mean,
                                     std::span<const std::uint32_t> already) {
    const double largest = given.empty() ? 0 : *std::ranges::max_element(given);
    std::vector<std::uint32_t> rays(given.size());
    if (!(largest > 0))
        return rays;
    const std::vector<double> weights = rounded(given, largest);
    const auto deal = [&](double per_weight) {
        double sum = 0, count = 0;
        for (std::size_t i = 0; i < weights.size(); ++i) {
            if (!(weights[i] > 0))
                continue;
            const double share =
                std::clamp(per_weight * weights[i], least_share * mean, most_share * mean);
            rays[i] = std::max(power_of_two(share), already[i]);
            sum += rays[i];
            ++count;
        }
        return sum <= mean * count;
    };
    // The number of rays per weight that deals out what there is, by bisection of its logarithm.
    double low = std::log(least_share * mean), high = low + 80;
    for (int k = 0; k < 50; ++k) {
        const double middle = (low + high) / 2;
        (deal(std::exp(middle)) ? low : high) = middle;
    }
    deal(std::exp(low));
    return rays;
}

} // namespace hemilux
