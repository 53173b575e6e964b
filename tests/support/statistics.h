#pragma once
// Hypothesis tests for sampling code. Every test has a fixed seed and a stated significance: the
// probability with which correct code would fail for *some* seed. Where a test case makes many
// tests, `sidak` shares the significance out among them.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

namespace hemilux::test {

/// What a whole test case is allowed to fail by chance.
inline constexpr double significance = 1e-3;

/// The significance of one of n independent tests that together have `total`.
[[nodiscard]] double sidak(double total, std::size_t n);

struct ChiSquare {
    double statistic = 0;
    std::size_t degrees = 0;
    double p_value = 1; ///< probability of at least this statistic if the counts are as expected
};

/// Pearson's test. Cells in which fewer than five samples are expected are pooled. `expected` holds
/// probabilities with the sum 1; a count where the probability is 0 gives p = 0.
[[nodiscard]] ChiSquare chi_square(std::span<const std::uint64_t> counts,
                                   std::span<const double> expected);

/// The same over any domain: `draw_cell` draws a sample and says into which cell it falls; a cell
/// beyond `expected` means outside and gives p = 0. Choose cells whose edges miss those of the
/// distribution under test, e.g. 7 x 11 over a square.
[[nodiscard]] ChiSquare chi_square(std::uint64_t samples, std::span<const double> expected,
                                   const std::function<std::size_t()>& draw_cell);

/// Mean and its standard error; a two-sided Student test says how well it fits a known value.
class MeanTest {
  public:
    void add(double value);
    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] double mean() const { return mean_; }
    [[nodiscard]] double standard_error() const;
    /// Probability of a mean at least this far from `expected` if that is the true one.
    [[nodiscard]] double p_value(double expected) const;

  private:
    std::size_t count_ = 0;
    double mean_ = 0, squares_ = 0;
};

/// Probability that a standard normal variable is at least |z| from 0.
[[nodiscard]] double normal_p_value(double z);
/// Probability that Student's t with these degrees of freedom is at least |t| from 0.
[[nodiscard]] double student_p_value(double t, double degrees);
/// Probability that chi-square with these degrees of freedom is at least x.
[[nodiscard]] double chi_square_p_value(double x, double degrees);

} // namespace hemilux::test
