#pragma once
// Writes a glTF file as it is, with a lightmap. What the file says stays: nodes, names, materials,
// textures, cameras, animations, extensions and extras that hemilux does not know. Added are the
// picture, its texture and sampler, one set of texture coordinates where the file has none for it,
// and what binds the texture to materials.
//
// With Binding::lit primitives get materials of their own, which any viewer shows as they are lit.
// Those of the file stay as another variant (KHR_materials_variants), with the lightmap.
//
// The result is a binary file that holds all buffers, and the pictures that lay beside the file.

#include "io/gltf/binding.h"
#include "io/gltf/lit_source.h"

#include <string>
#include <vector>

namespace hemilux {

/// A picture of the light of some primitives.
struct LightmapPicture {
    std::string name = "lightmap"; ///< of its image and texture
    std::string png = {};
    std::string shown =
        {}; ///< PNG: colours times light, as screens show them; of Binding::lit alone
    std::vector<std::size_t> origins = {}; ///< numbers of LitSource::origins() whose light it is
    double intensity = 1;                  ///< the irradiance of the largest number of the picture
    std::size_t set = 1;                   ///< of texture coordinates
    /// The coordinates that are added as that set; empty: the file has it.
    std::vector<gltf::AtlasCoordinates> coordinates = {};
};

struct LightmapOfFile {
    /// Where there are several, objects that share a mesh or a material get copies of it.
    std::vector<LightmapPicture> pictures;
    Binding binding = Binding::lightmap;
    std::string command; ///< by which it was made, for the texture's extras; empty: not there
    std::string bake;    ///< the name of the light, for these extras
    double exposure = 1; ///< for these extras
};

/// Throws OutputError, and InputError for buffers that cannot be read.
void write_lit_glb(const std::string& path, gltf::LitSource& source,
                   const LightmapOfFile& lightmap);

} // namespace hemilux
