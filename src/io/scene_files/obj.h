#pragma once
// Reads Wavefront OBJ files with their MTL material libraries.
//
// Read: v, f, g, o, usemtl, mtllib. Faces of any shape become triangles and planar convex quads
// (polygon_division.h). A face belongs to the group of the latest `g` since the last `o`, else to
// that `o`, else to "default"; several names after one `g` are one name with blanks. A face before
// any usemtl has the material "default"; it and those that no library defines have reflectance 0.5.
// Texture coordinates, normals, smoothing, lines, points and free-form surfaces are left out.

#include "radiosity/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace hemilux {

/// Facet::face counts the `f` lines of the file from 0, also those that give no facet. Materials
/// and groups are in the order in which they are defined or first used by a face.
struct ReadResult {
    Scene scene;
    std::vector<std::string> warnings;        ///< "file: ..." or "file:line: ..."
    std::vector<std::string> material_source; ///< "file:line" of each material; "" if from no file
    std::vector<std::string> libraries;       ///< paths of the MTL files that were read
    std::vector<std::string> textures;        ///< paths that they name; these are not read
    std::vector<std::uint32_t> face_lines;    ///< where each `f` stands, from 1
    std::size_t degenerate_faces = 0; ///< without area or with fewer than 3 corners; left out
    std::size_t nonplanar_faces = 0;
    std::size_t concave_faces = 0;
};

/// Called now and then while a scene is read, with about the bytes that reading it takes so far or
/// will take next. What it throws ends the reading.
using ReadGuard = std::function<void(double bytes)>;

/// Throws InputError for a file that cannot be read, with file and line for what is wrong in it,
/// and where no face has an area.
[[nodiscard]] ReadResult read_obj(const std::string& path, const ReadGuard& guard = {});

} // namespace hemilux
