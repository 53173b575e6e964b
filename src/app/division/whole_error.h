#pragma once
// Which error a run is asked for, and what the settings say of how it gets there.

#include "app/settings/settings.h"
#include "io/results/statistics.h"
#include "radiosity/answers/division/whole_error.h"

#include <cstddef>
#include <optional>

namespace hemilux {

/// Returns the whole error that a run is to reach, relative [-].
[[nodiscard]] double whole_error(const SolveSettings& settings);

/// Returns the error that gathered light is to reach, relative [-].
[[nodiscard]] double error_of_gathered(const SolveSettings& settings);

/// Returns whether all light that is given out is gathered at points or for pictures, none as
/// patches have it. The whole error is then that of gathered light.
[[nodiscard]] bool gives_gathered_light(const SolveSettings& settings);

/// Returns whether a plain run on so many patches divides them. It does where the method is the
/// standard one, what was asked for says nothing of patches or single steps, and a mesh is written,
/// which shows no more than its patches have.
[[nodiscard]] bool divides_by_default(const SolveSettings& settings, std::size_t patches);

/// Returns how patches are divided.
[[nodiscard]] DivisionChoices division_choices(const SolveSettings& settings);

/// Returns what is chosen of the run, which needs so many bytes besides what the solver keeps.
[[nodiscard]] RunChoices run_choices(const SolveSettings& settings, double bytes_needed = 0);

/// Returns whether the error of the division is found out: with --divide auto, or where
/// --whole-error asks for it and rays are not for the target's own patches.
[[nodiscard]] bool finds_whole_error(const SolveSettings& settings, const Solution& solution);

/// Returns why a run has not reached the whole error asked for; empty where it has.
[[nodiscard]] std::optional<Finding> whole_error_note(const SolveSettings& settings,
                                                      const Statistics& statistics);

} // namespace hemilux
