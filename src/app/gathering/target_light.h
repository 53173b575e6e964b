#pragma once
// The patches of a target (--for group:NAME and points:FILE): their light is gathered at points of
// each, from light that was learned for them. So it is right where the patches around are coarse.

#include "app/rendering/view.h"
#include "app/settings/settings.h"
#include "io/results/statistics.h"
#include "radiosity/paper/solution/solution.h"
#include "radiosity/paper/solving/solver.h"

namespace hemilux {

/// Returns whether the patches of a run are gathered: it has a target of patches, which are given
/// out as they are.
[[nodiscard]] bool gathers_target(const SolveSettings& settings);

/// Replaces the radiosity of patches that have a weight by the mean over their points, and their
/// standard error; enters the error into the statistics. Leaves all as it is if it was interrupted.
void gather_target(const SolveSettings& settings, const LitScene& scene, Solution& solution,
                   Monitor& monitor, Statistics& statistics);

} // namespace hemilux
