#include "radiosity/stored_transport/ray_allocation.h"

#include "radiosity/sampling/rng.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace hemilux {
namespace {

constexpr double least_share = 1.0 / 8;

/// The least where patches are not of the same importance. With an eighth, patches with many rays
/// inherit too much of what those with few are off by (docs/decisions.md, D57).
constexpr double least_of_expected = 1.0 / 4;

/// The power of two nearest to a number, in logarithms: the whole part of log2(sqrt(2) rays), which
/// is an exponent's bits. The allocation asks for it ten times a patch.
std::uint32_t power_of_two(double rays) {
    constexpr std::uint64_t mantissa_bits = 52, bias = 1023;
    const auto bits = std::bit_cast<std::uint64_t>(std::numbers::sqrt2 * std::max(rays, 1.0));
    return std::uint32_t{1} << std::min<std::uint64_t>((bits >> mantissa_bits) - bias, 31);
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

/// A patch, and its rays at both ends of a range of rays per weight and in the middle.
struct Open {
    std::uint32_t index, low, high, middle = 0;
};

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
        most_share_of_rays * (expected.empty() ? 1 : *std::ranges::max_element(expected));
    const auto least = [&](std::uint32_t i) {
        return expected.empty() ? least_share : least_of_expected * expected[i];
    };
    const auto rays_of = [&](std::uint32_t i, double per_weight) {
        const double share = std::clamp(per_weight * weights[i], least(i) * mean, most * mean);
        return std::max(power_of_two(share), already[i]);
    };
    // The number of rays per weight that allocates what there is, by bisection of its
    // logarithm. A patch that gets as many at one end as at the other needs no more asking.
    double low = std::log(least_share * mean), high = low + 80;
    std::vector<Open> open;
    for (std::uint32_t i = 0; i < weights.size(); ++i)
        if (weights[i] > 0)
            open.push_back({i, rays_of(i, std::exp(low)), rays_of(i, std::exp(high))});
    const double all = mean * static_cast<double>(open.size());
    std::uint64_t fixed = 0;
    for (int k = 0; k < 50 && !open.empty(); ++k) {
        const double middle = (low + high) / 2, per_weight = std::exp(middle);
        std::uint64_t sum = fixed;
        for (Open& patch : open)
            sum += patch.middle = rays_of(patch.index, per_weight);
        const bool enough = static_cast<double>(sum) <= all;
        (enough ? low : high) = middle;
        std::erase_if(open, [&](Open& patch) {
            (enough ? patch.low : patch.high) = patch.middle;
            if (patch.low < patch.high)
                return false;
            fixed += rays[patch.index] = patch.low;
            return true;
        });
    }
    for (const Open& patch : open)
        rays[patch.index] = patch.low;
    return rays;
}

} // namespace hemilux
