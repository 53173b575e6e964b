#pragma once
// Allocates rays to patches where the error is.

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

/// A patch gets at most so many times the mean. A wall of a finely tessellated model holds as much
/// of the error as thousands of its facets.
inline constexpr double max_share_of_rays = 1024;

/// Returns the rays per patch, `mean` of them on average, in proportion to the weights. A patch
/// gets at least an eighth and at most `max_share_of_rays` times the mean, and never less than it
/// has already. Numbers are powers of two, for which well-distributed points are best. A weight of
/// 0 gets none.
///
/// `expected` gives what is expected for each patch, over the mean, where patches are not of the
/// same importance; else it is empty. With it a patch gets at least a quarter of that, and at most
/// `max_share_of_rays` times the largest.
[[nodiscard]] std::vector<std::uint32_t> allocate_rays(std::span<const double> weights, double mean,
                                                       std::span<const std::uint32_t> already,
                                                       std::span<const double> expected = {});

} // namespace hemilux
