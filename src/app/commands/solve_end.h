#pragma once
// The end of `solve`: the figures of the run, its outputs, its warnings.

#include "app/loading/reference.h"
#include "app/outputs/results.h"
#include "app/settings/settings.h"
#include "parallel/stopwatch.h"
#include "radiosity/answers/division/whole_error.h"

#include <optional>

namespace hemilux {

/// What the stages of a run returned.
struct StageFigures {
    double seconds_read = 0, seconds_tree = 0;
    double seconds_solver = 0; ///< density rays included
    DivisionWork division = {};
    WholeError error;
    bool is_whole = false; ///< the error of the division was to be found out
};
/// Puts together what is known of a solution, before light is gathered from it.
[[nodiscard]] Statistics statistics_of(const SolveSettings& settings, const Problem& problem,
                                       const Solution& solution, const StageFigures& stages);

/// Writes the outputs and logs the last lines; returns the exit code. `of_steps` is what was
/// written after steps, `of_run` what there is to say of these. `seconds_before` is the time [s] of
/// the run that this one continues.
[[nodiscard]] int finish(const SolveSettings& settings, Results results,
                         const WriteReport& of_steps, const std::optional<Reference>& reference,
                         const Findings& of_run, bool interrupted, const Stopwatch& started,
                         double seconds_before);

} // namespace hemilux
