#pragma once
// Accounts for the light that an iteration has left unsolved where it ended at its limit.
//
// Let e be the error of the light and r the residual of its equation: e - rho F e = r. What each
// reflection leaves of e is at most the largest reflectance of it, so |e| <= |r| / (1 - max rho).
// This holds for light as it adds up over areas, where A_i F_ij is symmetric and rows sum to 1 at
// most. Where a surface reflects everything there is no such bound.

namespace hemilux {

class Mesh;
struct Solution;

/// Returns the bound of the error, relative to the light, by the residual that is relative to it
/// and what is lost in each reflection at least [-]; infinity where that is nothing.
[[nodiscard]] double unsolved_error(double residual, double lost_at_least);

/// Throws SolveError where a bound is infinite.
void check_bounded(double share);

/// Adds to the errors of a solution that all reflected light may be off by this share of it.
void add_unsolved(double share, const Mesh& mesh, Solution& solution);

} // namespace hemilux
