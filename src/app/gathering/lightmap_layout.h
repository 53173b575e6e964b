#pragma once
// Where surfaces lie in the lightmap of a run.

#include "app/settings/settings.h"
#include "io/gltf/lit_source.h"
#include "io/scene_files/lit_obj.h"
#include "radiosity/answers/lightmaps/texel_map.h"
#include "radiosity/paper/solution/solution.h"

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace hemilux {

struct LightmapLayout {
    std::vector<PlacedTriangle> triangles; ///< places in texels
    int size = 0;                          ///< texels along a side
    int margin = 0;                        ///< texels around charts that are filled
    /// By facet, of FileLightmap; empty: texels have those of their facets.
    std::span<const CornerNormals> normals = {};
};

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

/// Returns the texels of a layout, whose triangles show these sides. Both must outlive it.
[[nodiscard]] TexelMap texels_of(const LightmapLayout& layout,
                                 std::vector<PlacedTriangle> triangles, const Mesh& mesh,
                                 const Tracer& tracer);

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

/// Lets the triangles of each chart show the brighter side of two-sided facets, by the light of the
/// patches: a place in a lightmap has one light, and viewers show it on both sides.
void show_brighter_sides(const Mesh& mesh, const Solution& solution,
                         std::vector<PlacedTriangle>& triangles);

} // namespace hemilux
