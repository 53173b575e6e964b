#pragma once
// A scene file of any format that is read.

#include "io/scene_files/read_result.h"

#include <string>

namespace hemilux {

/// The formats by their extensions, for messages and help.
inline constexpr const char* scene_formats = ".obj, .gltf, .glb or .stl";

/// Reads the file as its extension says, with its textures or without. Throws InputError.
[[nodiscard]] ReadResult read_scene_file(const std::string& path, const ReadGuard& guard,
                                         bool textures);

} // namespace hemilux
