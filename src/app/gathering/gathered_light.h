#pragma once
// The light of outputs for which it is gathered: which light the settings want, and what the
// statistics and the log say of it.

#include "app/settings/settings.h"
#include "io/results/points.h"
#include "io/results/statistics.h"
#include "radiosity/answers/gathering/wanted_light.h"
#include "radiosity/paper/solving/solver.h"

#include <span>

namespace hemilux {

/// Returns whether any output shows gathered light.
[[nodiscard]] bool gathers(const SolveSettings& settings);

/// Returns whether pictures, and whether lightmaps show gathered light.
[[nodiscard]] bool gathers_picture(const SolveSettings& settings);
[[nodiscard]] bool gathers_lightmap(const SolveSettings& settings);

/// Returns whether the light of the patches of a target is gathered, once a run is done.
[[nodiscard]] bool gathers_target(const SolveSettings& settings);

/// Returns what is asked of gathered light: the error, and the rays that --max-rays leaves after
/// those of the solution and all that the statistics count.
[[nodiscard]] Asked asked_of_gathers(const SolveSettings& settings, const Solution& solution,
                                     const Statistics& statistics);

/// Returns the same of the patches of a target.
[[nodiscard]] Asked asked_of_target(const SolveSettings& settings, const Solution& solution,
                                    const Statistics& statistics);

[[nodiscard]] std::vector<WantedPoint> wanted_points(std::span<const NamedPoint> points);

/// Adds what gathered light took. Where only gathered light is given out, its error is that of the
/// run.
void add_gathered(Statistics& statistics, const SolveSettings& settings,
                  const GatheredLight& gathered);

/// Adds what it took to gather the light of a target, and its error, which is that of the run.
void add_target(Statistics& statistics, const Answer<Solution>& gathered);

/// Logs the error of the light at points where the error of the run is that of other light.
void log_error_of_points(const SolveSettings& settings, const GatheredLight& gathered);

} // namespace hemilux
