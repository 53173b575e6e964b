#pragma once
// The light of the patches that matter for a target, gathered at points of each.

#include "radiosity/answers/asked/answer.h"
#include "radiosity/answers/pictures/lit_scene.h"
#include "radiosity/paper/solution/solution.h"
#include "radiosity/paper/solving/solver.h"

#include <optional>

namespace hemilux {

/// Returns a solution in which patches with a weight (Solution::weight) have gathered light, with
/// its standard error; all other patches keep theirs. Returns nothing where the monitor ended it.
[[nodiscard]] std::optional<Answer<Solution>> gather_patches(const LitScene& scene,
                                                             const Solution& solution,
                                                             const Asked& asked, Monitor& monitor);

} // namespace hemilux
