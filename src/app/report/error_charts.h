#pragma once
// Errors against seconds and rays, as pages and error.svg show them.

#include "io/drawings/plot.h"
#include "io/results/tables.h"

#include <array>
#include <span>
#include <string>
#include <vector>

namespace hemilux {

/// A kind of error of a step.
struct ErrorKind {
    const char* name;
    double (*of)(const StepRow&); ///< relative [-]; NaN where it is not known
};
inline constexpr std::size_t true_kind = 0, estimated_kind = 1, total_kind = 4;
/// The kinds: true, estimated, true of details, true of the rest, of the light itself.
[[nodiscard]] const std::array<ErrorKind, 5>& error_kinds();

/// A curve: the mean error of some runs.
struct ChartedRuns {
    std::string name;
    std::vector<std::span<const StepRow>> runs;
    const ErrorKind* kind;
};

/// Returns a chart with a panel for the time and one for the rays. `title` and `y_label` stand
/// above them.
[[nodiscard]] Chart error_chart(const std::string& title, const std::string& y_label,
                                std::span<const ChartedRuns> curves);

/// A chart of a page.
struct PageChart {
    std::string name;
    std::string svg; ///< empty where no such error is known
};
/// Returns the chart of a page. Dots are the steps of the first run of each curve, or some hundred
/// of them, with their numbers under the pointer; that of step 7 has the class `step7`.
[[nodiscard]] PageChart page_chart(const std::string& name, std::span<const ChartedRuns> curves);

} // namespace hemilux
