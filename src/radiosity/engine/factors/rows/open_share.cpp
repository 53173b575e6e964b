#include "radiosity/engine/factors/rows/open_share.h"

#include <algorithm>
#include <cmath>

namespace hemilux {

OpenShare share_of_blocks(std::span<const std::uint32_t> counts, std::uint32_t of_block,
                          double of_independent) {
    const auto blocks = static_cast<double>(counts.size());
    double sum = 0, squares = 0;
    for (const std::uint32_t count : counts)
        sum += count;
    for (const std::uint32_t count : counts)
        squares += (count - sum / blocks) * (count - sum / blocks);
    // The variance of Student's distribution with so many degrees of freedom.
    const double freedom = blocks - 1, spread = freedom / (freedom - 2);
    const double variance =
        of_independent * spread * squares / (blocks * freedom * of_block * of_block);
    const double rays = blocks * of_block;
    // Where all blocks agree, half a ray may be elsewhere.
    const double least = (sum > 0 && sum < rays ? .5 : 1.5) / rays;
    return {sum / rays, std::max(std::sqrt(variance), least)};
}

} // namespace hemilux
