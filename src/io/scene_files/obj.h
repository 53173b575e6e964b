#pragma once
// Reads Wavefront OBJ files with their MTL material libraries.
//
// The statements v, vt, f, g, o, usemtl and mtllib are read. Faces of any shape become triangles
// and planar convex quads (polygon_division.h). A face belongs to the group of the latest `g` since
// the last `o`, else to that `o`, else to "default". Several names after one `g` are one name with
// blanks. A face before any usemtl has the material "default"; it and those that no library defines
// have reflectance 0.5. Normals, smoothing, lines, points and free-form surfaces are left out.

#include "io/scene_files/read_result.h"

#include <string>

namespace hemilux {

/// Facet::face counts the `f` lines of the file from 0, also those that give no facet. Materials
/// and groups are in the order in which they are defined or first used by a face. Throws InputError
/// for a file that cannot be read, with file and line for what is wrong in it, and where no face
/// has an area. Without `textures`, colours are Kd and Ke alone.
/// Files outside the scene's folder are read, with a warning, or refused.
[[nodiscard]] ReadResult read_obj(const std::string& path, const ReadGuard& guard = {},
                                  bool textures = true, Outside outside = Outside::reported);

} // namespace hemilux
