#pragma once
// The output of `bake`: the scene's own file with its light, and the lightmap beside it.

#include "app/running/results.h"

#include <string>

namespace hemilux {

/// Writes the .glb file, and the lightmap as an .exr file as an attempt of its own. Throws
/// OutputError, and Interrupted where a signal left no light.
void write_lit_file(const SolveSettings& settings, const std::string& path, const Results& results,
                    WriteReport& report);

} // namespace hemilux
