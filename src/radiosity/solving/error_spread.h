#pragma once
// How well an estimated error is known itself.
//
// The error of a solution consists of independent parts: thousands where each patch errs for
// itself, a handful where all patches err together, as by the light of a sky that few rays found.
// The estimate comes from the spread of a few samples. Its square, and that of the true error, are
// sums over the parts, so both scatter by 1 / sqrt(parts): one error in a few parts may well be
// twice what was told.

#include <optional>
#include <span>

namespace hemilux {

class Mesh;
struct Solution;

struct ErrorSpread {
    double parts = 0;   ///< of equal size, to which the error amounts; at least 1
    double freedom = 0; ///< samples less one, of which the estimate is made

    /// Relative standard deviation of the estimated error.
    [[nodiscard]] double uncertainty() const;
    /// In 39 of 40 runs the true error is below so many times the estimated one: the ratio of their
    /// squares has Fisher's F distribution.
    [[nodiscard]] double bound() const;
    /// What an error is multiplied with before it is reported, so that the true one is below 1.5
    /// times the reported one in as many runs; 1 where there are more than some ten parts.
    [[nodiscard]] double reported() const;
};

/// Of the error that the solution's variance tells. Where a method does not say how many parts
/// there are (Solution::error_parts) patches are taken to err each for itself. NaN before two
/// steps.
[[nodiscard]] ErrorSpread error_spread(const Mesh& mesh, const Solution& solution);

/// Parts of an error whose variance is the sum of `of_patch`, where each patch errs for itself but
/// for the part `shared` that all err together: by whichever gives fewer. Infinite where nothing
/// errs.
[[nodiscard]] double error_parts_of(std::span<const double> of_patch, double shared);

/// Parts from the scalar products of what each of some samples is off from their mean, all with
/// all: row by row, `samples` squared of them. With G this matrix of n degrees of freedom and P
/// parts, tr G^2 / (tr G)^2 is about (1 + (n + 1) / P) / (n + 2 / P) (moments of the Wishart
/// distribution).
[[nodiscard]] double error_parts(std::span<const double> products, std::size_t samples);

/// The same after a step: as few as any step before has shown, since a few samples in which a
/// common error happens to be small show many parts.
[[nodiscard]] double believed_parts(std::optional<double> before, double now);

} // namespace hemilux
