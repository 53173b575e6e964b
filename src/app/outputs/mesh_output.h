#pragma once
// The light of a run as a mesh, at its vertices or in a lightmap.

#include "app/outputs/results.h"
#include "radiosity/answers/vertices/smooth.h"

namespace hemilux {

/// Writes a .ply or .glb file of the patches, and its lightmap where one is asked for: each is an
/// attempt of its own, so that neither's failure takes the other. Throws OutputError.
void write_mesh(const SolveSettings& settings, const Output& output, const Results& results,
                const CornerClasses& classes, WriteReport& report);

/// Writes the lightmaps of `bake` beside the .glb file at this path, each as an attempt of its own.
void write_lightmaps(const SolveSettings& settings, const std::string& path,
                     const FileLightmap& file, std::span<const Image> lightmaps,
                     WriteReport& report, const LampLight& lamps = {});

} // namespace hemilux
