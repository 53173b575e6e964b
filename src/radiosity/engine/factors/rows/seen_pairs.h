#pragma once
// Pairs of patches that rays found, and what these rays alone say of their exchange.

#include "radiosity/engine/factors/pairs/free_exchange.h"
#include "radiosity/engine/factors/rows/exchange_list.h"
#include "radiosity/engine/factors/rows/row_rays.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

/// A pair of which rays of one hit the other, and how many did, from either side.
struct SeenPair {
    std::uint32_t to, rays;
};

/// Makes lists of what each patch saw lists of those of higher index that it saw or was seen by,
/// ascending.
[[nodiscard]] std::vector<std::vector<SeenPair>> pairs_of(std::vector<std::vector<SeenPatch>> seen);

/// Estimates the pairs of a row by the rays that found them. With E the exchange, n rays of N from
/// each patch are expected to be N E (1/A_i + 1/A_j), with the variance of counts. `missed` gets
/// what pairs that no ray hit exchange: as much as those that one ray hit (Good 1953).
void pairs_by_rays(std::uint32_t i, std::span<const FacePlane> faces,
                   std::span<const SeenPair> seen, std::uint32_t rays,
                   std::vector<PairExchange>& pairs, std::vector<float>& missed);

} // namespace hemilux
