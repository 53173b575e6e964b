#pragma once
// Allocates rays to patches where the error is.

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

/// So many times the mean is the most that a patch gets: a wall of a finely tessellated model holds
/// as much of the error as thousands of its facets.
inline constexpr double most_share_of_rays = 1024;

/// Rays per patch, `mean` of them on average, in proportion to the weights, but at least an eighth
/// and at most `most_share_of_rays` times the mean, and never less than a patch has already. Powers
/// of two, for which well-distributed points are best. A weight of 0 gets none.
///
/// `expected`: of each patch, over the mean, where patches are not of the same importance; empty:
/// of the same. Then it is at least a quarter of that, and at most so many times the largest.
[[nodiscard]] std::vector<std::uint32_t> allocate_rays(std::span<const double> weights, double mean,
                                                       std::span<const std::uint32_t> already,
                                                       std::span<const double> expected = {});

} // namespace hemilux
