#pragma once
// Which patches are to be divided, and how often, so that the light on them is known well enough.

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

struct LevelOptions {
    double goal; ///< of the sum of all squared errors
    /// Bound how many pieces the patches are to become.
    std::size_t least_pieces, most_pieces;
};

/// Levels of division by patch, 0 to 2: each level makes four of one. `square` is the squared error
/// of each patch, in any unit; estimates, which may be negative. Errors are made even: a patch is
/// divided while a piece of it errs more than a bound that is as large as the goal allows
/// (equidistribution: Babuska and Rheinboldt 1978).
[[nodiscard]] std::vector<std::uint8_t> levels_of_division(std::span<const double> square,
                                                           const LevelOptions& options);

} // namespace hemilux
