#pragma once
// Reads glTF 2.0 (Khronos 2021), as .gltf with files beside it or within it, and as .glb.
//
// All triangles of the scene that the file shows are read, each with the name of its node as group.
// Node transforms that mirror turn the triangles around. The reflectance of a material is its base
// colour, also where it is a metal or lets light through, which is reported. Its emission is pi
// times emissiveFactor and emissiveStrength: a diffuse surface of radiance L emits pi L, and a
// lumen counts as a watt. A double-sided material has two sides where it belongs to an open
// surface; nobody sees the other side of a closed one. An unlit material (KHR_materials_unlit)
// shows its colours whatever light arrives: it emits pi times them, colours of vertices included,
// and reflects nothing, which is reported. Left out and reported: points, lines, colours of
// vertices of other materials, skins and morph targets.

#include "io/scene_files/read_result.h"

#include <string>

namespace hemilux {

/// Throws InputError with the JSON path of what is wrong. Without `textures`, colours are the
/// factors alone. Files outside the scene's folder are read, with a warning, or refused.
[[nodiscard]] ReadResult read_gltf(const std::string& path, const ReadGuard& guard = {},
                                   bool textures = true, Outside outside = Outside::reported);

} // namespace hemilux
