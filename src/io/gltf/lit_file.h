#pragma once
// Writes a glTF file as it is, with a lightmap. What the file says stays: nodes, names, materials,
// textures, cameras, animations, extensions and extras that hemilux does not know. Added are the
// picture, its texture and sampler, one set of texture coordinates where the file has none for it,
// and what binds the texture to materials.
//
// The result is a binary file that holds all buffers, and the pictures that lay beside the file.

#include "io/gltf/binding.h"
#include "io/gltf/lit_source.h"

#include <string>
#include <string_view>
#include <vector>

namespace hemilux {

struct LightmapOfFile {
    std::string_view png;
    Binding binding = Binding::lightmap;
    double intensity = 1; ///< the irradiance of the largest number of the picture
    std::size_t set = 1;  ///< of texture coordinates
    /// The coordinates that are added as that set; empty: the file has it.
    std::vector<gltf::AtlasCoordinates> coordinates = {};
    std::string command; ///< by which it was made, for the texture's extras; empty: not there
    std::string bake;    ///< the name of the light, for these extras
    double exposure = 1; ///< for these extras
};

/// Throws OutputError, and InputError for buffers that cannot be read.
void write_lit_glb(const std::string& path, gltf::LitSource& source,
                   const LightmapOfFile& lightmap);

} // namespace hemilux
