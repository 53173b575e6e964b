#pragma once
// The end of `solve`: the figures of the run, its outputs, its warnings.

#include "app/loading/reference.h"
#include "app/outputs/results.h"
#include "app/running/run_notes.h"
#include "app/settings/settings.h"
#include "parallel/stopwatch.h"

#include <optional>

namespace hemilux {

/// Fills in what is known of a solution. `seconds_solver` is the time of the solver [s], its
/// density rays included.
void fill(Statistics& statistics, const SolveSettings& settings, const Mesh& mesh,
          const Solution& solution, double seconds_solver);

/// Writes the outputs and logs the last lines; returns the exit code. `of_steps` is what was
/// written after steps. `seconds_before` is the time [s] of the run that this one continues.
[[nodiscard]] int finish(const SolveSettings& settings, Results results,
                         const WriteReport& of_steps, const std::optional<Reference>& reference,
                         const RunNotes& notes, bool interrupted, const Stopwatch& started,
                         double seconds_before);

} // namespace hemilux
