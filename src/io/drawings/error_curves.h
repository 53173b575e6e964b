#pragma once
// Error against what it cost, seconds or rays. These curves are nearly straight lines when both
// axes are logarithmic, so everything here is done with logarithms.

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace hemilux {

struct CurvePoint {
    double x;     ///< seconds or rays so far
    double error; ///< relative
};

/// The curve of one run: ascending in x, without points that have no logarithm.
using ErrorCurve = std::vector<CurvePoint>;

/// Adds a point unless x is not above that of the last one, or a number is not positive and finite.
void append(ErrorCurve& curve, CurvePoint point);

/// Several runs at common x: geometric mean, least and greatest error.
struct MeanCurve {
    std::vector<double> x, mean, low, high;
};

/// Returns the error at x, interpolated; empty where the curve does not reach.
[[nodiscard]] std::optional<double> error_at(const ErrorCurve& curve, double x);

/// Returns the mean of the runs over the x that all have, at up to `count` places evenly spaced in
/// log x. It is empty where they have none in common. Runs without a point do not count.
[[nodiscard]] MeanCurve mean_curve(std::span<const ErrorCurve> runs, std::size_t count = 100);

/// Returns the first x at which the error has come down to the given one. The result is empty where
/// it never does, or where the curve begins below it.
[[nodiscard]] std::optional<double> x_of_error(const ErrorCurve& curve, double error);

/// Returns how many times less the runs cost than those of the base at the same error: the smallest
/// that both reach. Least errors and costs are averaged as logarithms. A run that begins below the
/// error counts with its first point, so that the result may be too small. The result is empty
/// where the two have no error in common.
[[nodiscard]] std::optional<double> speed_up(std::span<const ErrorCurve> runs,
                                             std::span<const ErrorCurve> base_runs);

/// Returns the standard error of the gain of several runs from their spread, by a jackknife of its
/// logarithm. Run i of both is left out at once, as what disturbs the machine disturbs both. The
/// result is rough where the runs are few. It is empty where there are not two of both, or the gain
/// is not known without one.
[[nodiscard]] std::optional<double> speed_up_error(std::span<const ErrorCurve> runs,
                                                   std::span<const ErrorCurve> base_runs);

/// Returns the geometric mean. Numbers that are not positive and finite do not count; NaN if none
/// counts.
[[nodiscard]] double geometric_mean(std::span<const double> numbers);

} // namespace hemilux
