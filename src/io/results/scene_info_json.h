#pragma once
// What `info` found in a scene, for other programs.

#include "io/scene_files/inspect.h"
#include "radiosity/sides/orientation.h"

#include <optional>

namespace hemilux {

struct SceneReport {
    SceneInfo info;
    std::optional<Orientation> sides; ///< empty: not looked for
    std::size_t patches = 0;          ///< as divided
    std::vector<LeftOut> left_out;    ///< what the scene does not need
    std::vector<std::string> warnings;
    /// How far light is off within patches, relative to it; empty: not known.
    std::optional<double> error_division = {};
};

/// The object's text, one key a line. Sides are null where they were not looked for.
[[nodiscard]] std::string to_json(const SceneReport& report);

} // namespace hemilux
