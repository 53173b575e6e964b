#pragma once
// Tells how well an estimated error is known itself.
//
// The error of a solution has effective degrees of freedom. There are thousands where each patch
// errs independently, and a handful where all patches err together, as by the light of a sky that
// few rays found. The estimate comes from the spread of a few independent batches. Its square, and
// that of the true error, are sums over so many terms, so both scatter by 1 / sqrt(freedom). An
// error of few degrees of freedom may well be twice what is estimated.

#include <optional>
#include <span>

namespace hemilux {

class Mesh;
struct Solution;

struct ErrorSpread {
    double freedom = 0;       ///< effective degrees of freedom of the error; at least 1
    double batch_freedom = 0; ///< batches less one, of which the estimate is made

    /// Returns the relative standard deviation of the estimated error [-].
    [[nodiscard]] double uncertainty() const;
    /// Returns a factor [-]: in 39 of 40 runs the true error is below so many times the estimated
    /// one. The ratio of their squares has Fisher's F distribution.
    [[nodiscard]] double bound() const;
    /// Returns the factor by which an error is multiplied before it is reported. The true error is
    /// then below 1.5 times the reported one in as many runs. The factor is 1 from some ten degrees
    /// of freedom on.
    [[nodiscard]] double reported() const;
};

/// Returns the spread of the error that the solution's variance gives. If a method does not report
/// its degrees of freedom (Solution::effective_freedom), the errors of patches are taken as
/// independent. It is NaN before two steps.
[[nodiscard]] ErrorSpread error_spread(const Mesh& mesh, const Solution& solution);
/// Returns the spread of the part of that error besides the level of all light. This holds if the
/// level is known from few samples (Solution::level_freedom); else it is that of the whole error.
[[nodiscard]] ErrorSpread error_spread_besides_level(const Mesh& mesh, const Solution& solution);

/// Returns the degrees of freedom of an error whose variance is the sum of `of_patch`. Patches err
/// independently, except for a variance of `shared` that all have in common; the smaller number
/// that follows from either counts. It is infinite if all variances are 0.
[[nodiscard]] double effective_freedom_of(std::span<const double> of_patch, double shared);

/// Returns the degrees of freedom from the deviations of independent batches from their mean.
/// `products` are the scalar products of all pairs of deviations, row by row, `batches` squared of
/// them. With G this matrix of n degrees of freedom and P of the error, tr G^2 / (tr G)^2 is about
/// (1 + (n + 1) / P) / (n + 2 / P) (moments of the Wishart distribution).
[[nodiscard]] double effective_freedom(std::span<const double> products, std::size_t batches);

/// Returns the degrees of freedom to believe after a step, the fewest of all steps. A few batches
/// in which a common error happens to be small show many.
[[nodiscard]] double believed_freedom(std::optional<double> before, double now);

} // namespace hemilux
