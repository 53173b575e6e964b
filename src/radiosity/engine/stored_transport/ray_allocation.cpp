#include "radiosity/engine/stored_transport/ray_allocation.h"

#include "geometry/elementary.h"
#include "radiosity/paper/sampling/rng.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace hemilux {
namespace {

constexpr double min_share = 1.0 / 8;

/// The least share of what is expected for a patch, where patches are not of the same importance.
/// With an eighth, patches with many rays inherit too much of what those with few are off by
/// (docs/making/design.md, D57).
constexpr double min_of_expected = 1.0 / 4;

/// Returns the power of two nearest to a number, in logarithms: the largest up to sqrt(2) rays.
std::uint32_t power_of_two(double rays) {
    constexpr double most = 0x1p31;
    return std::bit_floor(
        static_cast<std::uint32_t>(std::min(most, std::numbers::sqrt2 * std::max(rays, 1.0))));
}

/// Returns a number from -1/2 to 1/2, another for each patch.
double dither(std::size_t patch) { return Rng(hash_words({patch})).uniform() - .5; }

/// Rounds weights to the nearest power of 2^(1/16) of the largest, so that rounding errors of areas
/// decide nothing. Then moves them up to half an octave up or down by the patch's number. This
/// decides who is first to get more rays among patches of one shape.
std::vector<double> rounded(std::span<const double> weights, double largest) {
    std::vector<double> result;
    for (std::size_t i = 0; i < weights.size(); ++i)
        result.push_back(
            weights[i] > 0
                ? elementary::exp2(std::round(16 * elementary::log2(weights[i] / largest)) / 16 +
                                   dither(i))
                : 0);
    return result;
}

} // namespace

std::vector<std::uint32_t> allocate_rays(std::span<const double> given, double mean,
                                         std::span<const std::uint32_t> already,
                                         std::span<const double> expected) {
    const double largest = given.empty() ? 0 : *std::ranges::max_element(given);
    std::vector<std::uint32_t> rays(given.size());
    if (!(largest > 0))
        return rays;
    const std::vector<double> weights = rounded(given, largest);
    const double most =
        max_share_of_rays * (expected.empty() ? 1 : *std::ranges::max_element(expected));
    const auto least = [&](std::uint32_t i) {
        return expected.empty() ? min_share : min_of_expected * expected[i];
    };
    const auto rays_of = [&](std::uint32_t i, double per_weight) {
        const double share = std::clamp(per_weight * weights[i], least(i) * mean, most * mean);
        return std::max(power_of_two(share), already[i]);
    };
    // Sets the rays and returns their sum.
    const auto allocate = [&](double log_per_weight) {
        const double per_weight = elementary::exp(log_per_weight);
        std::uint64_t sum = 0;
        for (std::uint32_t i = 0; i < weights.size(); ++i)
            if (weights[i] > 0)
                sum += rays[i] = rays_of(i, per_weight);
        return sum;
    };
    // Bisection of its logarithm finds the number of rays per weight that allocates what there is.
    // Where as many are allocated at both ends, all patches get as many at one as at the other.
    const double all =
        mean * double(std::ranges::count_if(weights, [](double weight) { return weight > 0; }));
    double low = elementary::log(min_share * mean), high = low + 80;
    std::uint64_t sum_low = allocate(low), sum_high = allocate(high);
    for (int k = 0; k < 50 && sum_low < sum_high; ++k) {
        const double middle = (low + high) / 2;
        const std::uint64_t sum = allocate(middle);
        const bool enough = double(sum) <= all;
        (enough ? low : high) = middle;
        (enough ? sum_low : sum_high) = sum;
    }
    allocate(low);
    return rays;
}

} // namespace hemilux
