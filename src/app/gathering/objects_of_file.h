#pragma once
// The objects of a glTF file that have lightmaps of their own: its nodes with meshes.

#include "io/gltf/lit_source.h"

#include <cstddef>
#include <string>
#include <vector>

namespace hemilux {

struct ObjectOfFile {
    std::string name;                 ///< a part of the name of a file, unique in any case
    std::vector<std::size_t> origins; ///< numbers of LitSource::origins()
    double area = 0;                  ///< of its fronts, in local units
};

/// Returns the nodes of which some triangle has an area, in the order of the file. A node that
/// shows its mesh many times (EXT_mesh_gpu_instancing) is an object for each.
[[nodiscard]] std::vector<ObjectOfFile> objects_of(const gltf::LitSource& source, const Mesh& mesh);

/// Returns a name that all systems take as a part of the name of a file: letters and digits of the
/// name, `-`, and what is not ASCII; `_` stands for all else. It has at most 60 bytes.
[[nodiscard]] std::string name_for_file(const std::string& name);

} // namespace hemilux
