#pragma once
// This decides which patches are divided, and how often, so that the light on them is known well
// enough.

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

struct LevelOptions {
    double goal; ///< of the sum of all squared errors
    /// These bound how many pieces the patches become.
    std::size_t min_pieces, max_pieces;
};

/// Returns the levels of division by patch, 0 to 2: each level makes four pieces of one. `square`
/// is the squared error of each patch, in any unit; these are estimates, which may be negative.
/// Errors are made even: a patch is divided while a piece of it has more than a certain error. This
/// bound is as large as the goal allows (equidistribution: Babuska and Rheinboldt 1978).
[[nodiscard]] std::vector<std::uint8_t> levels_of_division(std::span<const double> square,
                                                           const LevelOptions& options);

} // namespace hemilux
