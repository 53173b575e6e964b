#pragma once
// The light of a lightmap, gathered as pictures are (picture_gather.h), at the points that texels
// show.

#include "io/lightmaps/texel_map.h"
#include "io/meshes/baked_light.h"
#include "io/pictures/image.h"
#include "io/rendering/picture_error.h"
#include "radiosity/light/cached_light/light_cache.h"
#include "radiosity/light/cached_light/surface_light.h"

#include <cstdint>
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

/// Returns parts of the lightmap for which its light is learned, spread evenly over its texels.
[[nodiscard]] std::vector<TargetPart> lightmap_parts(const Mesh& mesh, const TexelMap& texels,
                                                     const std::vector<bool>& covered, Bake bake,
                                                     std::uint64_t seed);

/// Returns the judge of lightmaps by texels that are not covered.
[[nodiscard]] PictureJudge judge_of_lightmaps(const Mesh& mesh, const Tracer& tracer,
                                              const SurfaceLight& light, const TexelMap& texels,
                                              const std::vector<bool>& covered, Bake bake,
                                              std::uint64_t seed);

} // namespace hemilux
