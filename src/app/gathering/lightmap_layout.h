#pragma once
// Where surfaces lie in the lightmap of a run.

#include "app/settings/settings.h"
#include "io/gltf/lit_source.h"
#include "io/scene_files/lit_obj.h"
#include "radiosity/answers/lightmaps/lightmap_layout.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace hemilux {

/// A lightmap of an object of the file, or of all.
struct ObjectLightmap {
    std::string name = {};                 ///< ObjectOfFile::name; empty: of all objects
    std::vector<std::size_t> origins = {}; ///< numbers of LitSource::origins()
    LightmapLayout layout = {};
    int finer = 1;       ///< texels of the picture that viewers show, per texel, along a side
    std::size_t set = 0; ///< of texture coordinates
    bool is_new = false; ///< the set is not of the file
};

/// The scene's own file, and its lightmaps: one, or one for each object.
struct FileLightmap {
    std::unique_ptr<gltf::LitSource> source; ///< of a glTF file
    std::unique_ptr<LitObj> obj;             ///< of an OBJ file instead
    std::vector<CornerNormals> normals; ///< by facet; empty: not asked for, or the file has none
    std::vector<ObjectLightmap> parts;
};

/// Finds the layout of `bake`, or of each object: the texture coordinates that the file has for it,
/// or an atlas of our own, which is logged with what is wrong with those of the file. With several,
/// the largest object has as many texels as are asked for, and others have them as dense. Throws
/// UsageError for a scene that is no glTF file or no file at all, InputError for a set asked for
/// that cannot be used, and std::runtime_error where the lightmap is too small or needs more memory
/// than it may. Adds and logs what reading the file again has noticed.
[[nodiscard]] FileLightmap lightmap_of_file(const SolveSettings& settings, const Mesh& mesh,
                                            std::vector<PrimitiveOrigin> origins,
                                            std::vector<std::string>& warnings);

/// Returns the bytes of the scene's own file while it is written again: its buffers, their copy and
/// its JSON. They are 0 where it is not.
[[nodiscard]] double bytes_of_own_file(const SolveSettings& settings);

} // namespace hemilux
