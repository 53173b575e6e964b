#pragma once
// The light of a lightmap, gathered as pictures are (picture_gather.h), at the points that texels
// show. Texels are large: where light changes faster than the points of the grid are close
// together, each gathers by itself, and those of a surface share what they found.

#include "io/lightmaps/texel_map.h"
#include "io/meshes/baked_light.h"
#include "io/pictures/image.h"
#include "radiosity/light/cached_light/surface_light.h"

#include <functional>
#include <vector>

namespace hemilux {

class Workers;

struct LightmapOptions {
    Bake bake = Bake::radiosity;
    unsigned rays = 16;                  ///< PictureGatherOptions::rays
    unsigned round = 0;                  ///< PictureGatherOptions::round
    std::function<void()> check = [] {}; ///< may throw to end it; is called by several threads
};

/// The light of texels, and which of them were gathered. All others are black: those that show
/// nothing, and those that are covered.
struct GatheredLightmap {
    Image image; ///< [W/m2]
    std::vector<bool> known;
};

/// Returns what a point (with its patch) sends where this arrives [W/m2].
[[nodiscard]] Vec3 radiosity_of(const Mesh& mesh, const SurfacePoint& at, const Vec3& irradiance);

/// Gathers the light of the texels that are not covered.
[[nodiscard]] GatheredLightmap gather_lightmap(const Mesh& mesh, const Tracer& tracer,
                                               const SurfaceLight& light, const TexelMap& texels,
                                               const std::vector<bool>& covered,
                                               const LightmapOptions& options,
                                               const Workers& workers);

/// Takes the light that patches send or receive in place of that.
[[nodiscard]] GatheredLightmap lightmap_of_patches(const Mesh& mesh, const SurfaceLight& light,
                                                   const TexelMap& texels, Bake bake);

/// Fills unknown texels from the nearest known ones: covered ones of a chart from the same chart,
/// and up to `margin` texels around charts.
void fill_texels(GatheredLightmap& lightmap, const TexelMap& texels, int margin);

} // namespace hemilux
