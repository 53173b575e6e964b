#pragma once
// Which patches exchange light with which, how much, and how well that is known: half of a
// symmetric matrix, without what is 0.

#include "radiosity/engine/factors/rows/open_share.h"

#include <array>
#include <cstdint>
#include <vector>

namespace hemilux {

/// A F of a pair [square of the unit of length], which is the same from both sides.
struct PairExchange {
    std::uint32_t to;
    float deviation; ///< standard error of the exchange; 0: nothing lies between, it is exact
    double exchange;
};

/// All vectors are by patch.
struct ExchangeList {
    std::vector<double> area;
    std::vector<std::vector<PairExchange>> pairs; ///< those of higher index, ascending
    std::vector<std::array<OpenShare, opens>> open;
    std::vector<OpenShare> bands; ///< of the sky, by patch and band; empty: none are asked for
    /// Whether pairs are listed, too, of which no ray arrived: nothing else that is not exact
    /// exchanges light. The exchange of these is 0, and their deviation is what it may be.
    bool has_all_pairs = false;
    /// The sum of the row's factors that are not listed [-]: as expected, and a bound for 95 % of
    /// all rows.
    std::vector<double> unlisted, unlisted_bound;
};

} // namespace hemilux
