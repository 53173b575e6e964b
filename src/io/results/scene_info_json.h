#pragma once
// The findings of `info` in a scene, for other programs.

#include "io/scene_files/inspect.h"
#include "radiosity/light/sides/orientation.h"

#include <optional>

namespace hemilux {

struct SceneReport {
    SceneInfo info;
    std::optional<Orientation> sides; ///< empty: not looked for
    std::size_t patches = 0;          ///< patches as divided
    std::vector<LeftOut> left_out;    ///< what the scene does not need
    std::vector<std::string> warnings;
    /// The error of the light because it changes within patches, relative to the light; empty: not
    /// known.
    std::optional<double> error_division = {};
};

/// Returns the object's text, one key a line. Sides are null where they were not looked for.
[[nodiscard]] std::string to_json(const SceneReport& report);

} // namespace hemilux
