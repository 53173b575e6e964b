#pragma once
// Reads STL files (3D Systems 1989), text and binary: triangles without materials. Each `solid` of
// a text is a group.

#include "io/scene_files/read_result.h"

#include <string>

namespace hemilux {

/// Facet::face counts the triangles of the file from 0. All have the material "default" with
/// reflectance 0.5; their normals follow from their corners. Throws InputError for a file that
/// cannot be read, with line or byte for what is wrong in it, and where no triangle has an area.
[[nodiscard]] ReadResult read_stl(const std::string& path, const ReadGuard& guard = {});

} // namespace hemilux
