#pragma once
// The output of `bake`: the scene's own file with its light.

#include "app/gathering/lightmap_layout.h"
#include "app/settings/settings.h"
#include "io/pictures/image.h"

#include <string>

namespace hemilux {

/// Writes the .glb file with this lightmap. Throws OutputError.
void write_lit_file(const SolveSettings& settings, const std::string& path, const Mesh& mesh,
                    const FileLightmap& file, const Image& lightmap);

/// Writes the light of the lightmap of the file at `path` beside it. Throws OutputError.
void write_lightmap_exr(const SolveSettings& settings, const std::string& path,
                        const Image& lightmap);

} // namespace hemilux
