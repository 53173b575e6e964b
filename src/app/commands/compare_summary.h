#pragma once
// Compares several methods by their runs.

#include "app/commands/compare_run.h"
#include "io/drawings/error_curves.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hemilux {

/// The factor by which the base method's error costs less with this method; see `speed_up`.
struct Gain {
    double times = 1;                     ///< [-]
    std::optional<double> standard_error; ///< 0 for the base method; empty: unknown, as of one run
};

/// The means over the runs at their ends, geometric ones for errors; NaN: unknown.
struct MethodSummary {
    std::string label;
    double rays = 0, seconds = 0;
    RelativeError error;
    std::optional<double> total_error; ///< error with --total; curves and gains are then of it
    std::optional<double> relative_mse;
    double estimated_error = 0; ///< relative [-]
    std::uint64_t bytes_density = 0;
    std::vector<ErrorCurve> runs_by_seconds, runs_by_rays; ///< true error, or total
    std::size_t runs = 0;                                  ///< runs that count
    std::optional<Gain> gain_seconds, gain_rays;
};

/// Returns the runs that count: those that were interrupted only if there is no other.
[[nodiscard]] std::vector<const MethodRun*> runs_that_count(const MethodRuns& runs);

/// Summarises each method, in the order of the results, by the runs that count.
[[nodiscard]] std::vector<MethodSummary> summarise(std::span<const MethodRuns> results,
                                                   bool literal);

/// Returns a row of headings, then one per method; errors in per cent. A gain comes with its
/// standard error, or with a question mark where that is unknown.
[[nodiscard]] std::vector<std::vector<std::string>>
summary_rows(std::span<const MethodSummary> summaries);

/// Returns lines of text for a terminal of so many `columns`, 0: none. Fields stand two blanks
/// apart, the first flush left, the others flush right. Where the lines would be longer, columns in
/// which nothing is known are left out, and those that do not fit stand in a table below.
[[nodiscard]] std::string aligned_for(std::size_t columns,
                                      const std::vector<std::vector<std::string>>& rows);

/// Returns what the standard errors of the gains come from; empty where no gain has or lacks one.
[[nodiscard]] std::string gain_note(std::span<const MethodSummary> summaries);

} // namespace hemilux
