#pragma once
// Makes factors consistent: rows sum to 1 with sky, ground and backs, no factor is negative, and
// both factors of a pair belong to one exchange.
//
// Of all changes that close the rows, the smallest in units of the standard errors is made:
// minimise the sum over pairs of (change / deviation)^2 with the sum of each row fixed. With lambda
// the multipliers of the rows, the change of pair ij is variance_ij (lambda_i + lambda_j), and
//
//     lambda_i sum_j variance_ij + sum_j variance_ij lambda_j = what row i lacks,
//
// which is symmetric and solved by conjugate gradients. Factors that would become negative are set
// to 0 and the rest is closed again. Exact factors have a deviation of their quadrature's error, so
// that they move last.

#include "radiosity/engine/factors/rows/exchange_list.h"

namespace hemilux {

/// How much was moved, as a check of what was estimated.
struct ClosingAudit {
    double lacking_rms = 0, lacking_worst = 0; ///< of row sums before [-]
    std::uint32_t worst_row = 0;
    /// The same in units of what the standard errors let expect: about 1 by chance.
    double chance_rms = 0, chance_worst = 0;
    double largest_move = 0;       ///< of a factor that was sampled, in standard errors
    double largest_exact_move = 0; ///< of an exact factor [-]
    double left_worst = 0;         ///< of row sums afterwards [-]
    /// The same where the iterations ended at their limit, else 0. The errors of what may be moved
    /// in a row then hold what its sum is off by.
    double unsolved = 0;
    std::uint64_t set_to_zero = 0;        ///< factors
    std::uint64_t rows_beyond_chance = 0; ///< rows that lacked more than five standard errors
};

/// Closes all rows, by so many iterations a round at most. The deviations become those after the
/// change, which are smaller. Rows of patches that see nothing at all stay as they are.
[[nodiscard]] ClosingAudit close_rows(ExchangeList& list, std::uint32_t rays_of_row,
                                      int max_iterations = 400);

} // namespace hemilux
