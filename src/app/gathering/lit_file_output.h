#pragma once
// The output of `bake`: the scene's own file with its light.

#include "app/gathering/lightmap_layout.h"
#include "app/settings/settings.h"
#include "radiosity/answers/images/image.h"

#include <span>
#include <string>
#include <vector>

namespace hemilux {

/// Writes the .glb file with these lightmaps, those of FileLightmap::parts. Throws OutputError.
void write_lit_file(const SolveSettings& settings, const std::string& path, const Mesh& mesh,
                    const FileLightmap& file, std::span<const Image> lightmaps);

/// Returns the paths of the lightmaps beside a .glb file, in the order of FileLightmap::parts.
[[nodiscard]] std::vector<std::string> lightmap_paths(const std::string& glb,
                                                      const FileLightmap& file);

/// Returns how one looks at what was written, with its light; empty where that goes without saying.
[[nodiscard]] std::string how_to_look(const SolveSettings& settings, const FileLightmap& file);

} // namespace hemilux
