#pragma once
// --layers: the light of each lamp by itself, of all that outputs hold.

#include "app/memory/memory.h"
#include "app/settings/settings.h"
#include "io/results/statistics.h"
#include "radiosity/answers/lamps/light_of_lamps.h"
#include "radiosity/paper/solving/solver.h"

#include <string>
#include <vector>

namespace hemilux {

/// Throws UsageError where --layers is asked for and the run cannot give them.
void check_layers(const SolveSettings& settings);
/// Throws UsageError for a scene of too many lamps, and InputError for one without any. Adds to the
/// need of a run what its layers hold; throws std::runtime_error where that is more than --memory.
void check_layers(const SolveSettings& settings, const Mesh& mesh, const LayerSize& size,
                  MemoryNeed& need);

/// What the light of a run was found from; it refers to what lives in the caller.
struct LitRun {
    LitScene scene;
    const Solver& solver;
    const Solution& solution;
    const GatheredLight& gathered;
    const WantedLight& wanted;
    const Asked& asked; ///< of gathered light, with the rays that the run left
};

/// Finds the layers, where they are asked for, by the rays of the run. Enters their errors and what
/// they took into the statistics. There are none where a signal came first, which is said.
[[nodiscard]] LampLight find_lamp_light(const SolveSettings& settings, const LitRun& run,
                                        Monitor& monitor, Statistics& statistics);

/// Returns the names of layers for channels of pictures, which may have 31 letters: those that are
/// longer are cut, and remain different.
[[nodiscard]] std::vector<std::string> channel_names(const LampLayers& lamps);

} // namespace hemilux
