#pragma once
// The result of reading a scene file, whatever its format.

#include "io/files/outside_files.h"
#include "radiosity/answers/views/camera.h"
#include "radiosity/paper/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hemilux {

/// A primitive of a glTF file as a node shows it: the faces and vertices of the scene that were
/// read from it. Face k is its triangle k, also where it has no area and so no facet.
struct PrimitiveOrigin {
    std::size_t node, mesh, primitive;
    std::uint32_t first_face, faces, first_vertex, vertices;
    std::optional<std::size_t> instance = {}; ///< its number by EXT_mesh_gpu_instancing
};

/// A material in use that lets light through.
struct GlassMaterial {
    std::uint32_t material;
    Vec3 transmittance;  ///< [-], of light that crosses a face of it once
    std::string said_by; ///< what the file says
    bool open = false;   ///< its faces are panes of the scene (glass.h)
};

struct ReadResult {
    Scene scene;
    std::vector<std::string> warnings;        ///< "file: ..." or "file:line: ..."
    std::vector<GlassMaterial> glass;         ///< in the order of materials
    std::string glass_warning;                ///< the one about glass among these; empty: none
    std::vector<std::string> material_source; ///< "file:line" of each material; "" if from no file
    std::vector<std::string> libraries;       ///< paths of further files that were read
    std::vector<std::string> textures;        ///< paths that are named
    std::vector<std::uint32_t> face_lines;    ///< lines of the faces, from 1; empty: in no line
    std::size_t degenerate_faces = 0; ///< faces without area or with fewer than 3 corners; left out
    std::size_t nonplanar_faces = 0;
    std::size_t concave_faces = 0;
    std::optional<Camera> camera; ///< the first of the file
    std::string camera_name;
    std::vector<PrimitiveOrigin> origins; ///< in the order of faces; empty for other formats
};

/// A function that is called now and then while a scene is read, with about the bytes that reading
/// takes so far or will take next. What it throws ends the reading.
using ReadGuard = std::function<void(double bytes)>;

} // namespace hemilux
