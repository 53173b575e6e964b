#pragma once
// The file of `bake` while its light is gathered, so that a viewer shows it at once.

#include "app/gathering/lightmap_layout.h"
#include "radiosity/answers/pictures/lit_scene.h"

#include <atomic>
#include <span>

namespace hemilux {

/// Writes the .glb file of a bake with the light of the patches, before lightmaps that are not
/// small are gathered, where a run shows previews. What the run writes in the end does not depend
/// on it.
void preview_lit_file(const SolveSettings& settings, const LitScene& scene,
                      const Solution& solution, const FileLightmap& file,
                      std::span<const NamedLayout> layouts, const std::atomic<bool>& interrupted);

} // namespace hemilux
