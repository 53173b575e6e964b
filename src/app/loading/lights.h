#pragma once
// Puts the lights of the command line into a scene.

#include "app/settings/settings.h"
#include "radiosity/paper/scene/scene.h"

#include <string>
#include <vector>

namespace hemilux {

/// Adds the lights. Their groups and materials are `light 1`, `light 2`, `sun 1`, `sky`. Nothing is
/// added to a scene without faces.
void add_lights(Scene& scene, const SceneSettings& settings);

/// Returns whether a facet or a point emits light.
[[nodiscard]] bool emits(const Scene& scene);

/// Returns the materials whose names sound like emitters: "Ceiling_Light", "bulb", "lava".
[[nodiscard]] std::vector<std::string> likely_lamps(const Scene& scene);

} // namespace hemilux
