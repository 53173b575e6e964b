#pragma once
// The whole error of the light as given out: which error it is, and how large.

#include "app/division/auto_division.h"
#include "app/settings/settings.h"
#include "io/results/statistics.h"

#include <string>

namespace hemilux {

/// Returns the whole error that a run is to reach, relative [-].
[[nodiscard]] double whole_error(const SolveSettings& settings);

/// Returns the error that gathered light is to reach, relative [-].
[[nodiscard]] double error_of_gathered(const SolveSettings& settings);

/// Returns whether all light that is given out is gathered at points or for pictures, none as
/// patches have it. The whole error is then that of gathered light.
[[nodiscard]] bool gives_gathered_light(const SolveSettings& settings);
/// Returns the error of sampling [-] that patches may have where all light is gathered from them:
/// gathers average over patches, and learn what these lack.
[[nodiscard]] double sampling_of_gathered(const SolveSettings& settings);

/// Adds the error of the division to the statistics of a solution where --divide auto or
/// --whole-error asks for it. With --divide auto the estimated error becomes that of the light as
/// given out. With --for it stays unknown.
void add_division_error(Statistics& statistics, const SolveSettings& settings, const Mesh& mesh,
                        const Tracer& tracer, const Solution& solution, const Divided& divided,
                        const StopFlag& interrupted);

/// Returns why --divide auto has not reached the whole error asked for; empty where it has.
[[nodiscard]] std::string whole_error_note(const SolveSettings& settings,
                                           const Statistics& statistics);

} // namespace hemilux
