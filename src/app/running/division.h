#pragma once
// --divide auto, and what a solution on patches says of the light on the surfaces.

#include "app/settings/settings.h"
#include "io/results/statistics.h"

namespace hemilux {

/// Where --divide auto is asked for: which share of the whole error may be left by the division,
/// and which by sampling; their squares add up to a little less than one.
inline constexpr double division_share = .8, sampling_share = .5;

/// The whole error that a run with --divide auto is to reach.
[[nodiscard]] double whole_error(const SolveSettings& settings);

/// Divides the mesh until the division leaves no more than its share. Nothing where it is not asked
/// for. Returns whether patches were divided.
bool divide_as_asked(const SolveSettings& settings, Mesh& mesh, const Tracer& tracer,
                     Monitor& monitor, Statistics& statistics);

/// Adds the error of the division to the statistics of a solution, and with --divide auto makes the
/// estimated error that of the light as given out.
void add_division_error(Statistics& statistics, const SolveSettings& settings, const Mesh& mesh,
                        const Tracer& tracer, const Solution& solution,
                        const StopFlag& interrupted);

} // namespace hemilux
