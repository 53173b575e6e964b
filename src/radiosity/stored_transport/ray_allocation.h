#pragma once
// Allocates rays to patches where the error is.

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

/// The least and the most that a patch gets, over the mean.
struct AllocationRange {
    double least = 1.0 / 8, most = 8;
};

/// Rays per patch, `mean` of them on average, in proportion to the weights, but within a range of
/// the mean, and never less than a patch has already. Powers of two, for which well-distributed
/// points are best. A weight of 0 gets none.
[[nodiscard]] std::vector<std::uint32_t> allocate_rays(std::span<const double> weights, double mean,
                                                       std::span<const std::uint32_t> already,
                                                       const AllocationRange& range = {});

} // namespace hemilux
