#pragma once
// The light of a lightmap, gathered as pictures are (picture_gather.h), at the points that texels
// show. Texels are large: where light changes faster than the points of the grid are close
// together, each gathers by itself, and those of a surface share what they found.

#include "radiosity/answers/images/image.h"
#include "radiosity/answers/lightmaps/texel_map.h"
#include "radiosity/answers/vertices/baked_light.h"
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
    std::function<void()> check = [] {}; ///< throws Interrupted to end it; for several threads
    std::function<void(int rows)> rows_done = {}; ///< is called with the rows that are finished
};

/// The light of texels, and which of them are known. All others are black: those that show nothing,
/// those that are covered, and those of rows that are not finished.
struct GatheredLightmap {
    Image image; ///< [W/m2]
    std::vector<bool> known;
    int rows = 0;             ///< finished, from the first
    std::uint64_t traced = 0; ///< rays, but for those of paths that go on

    GatheredLightmap() = default;
    /// Makes a lightmap of which nothing is known.
    explicit GatheredLightmap(const TexelMap& texels);
};

/// Returns what a point (with its patch) sends where this arrives [W/m2].
[[nodiscard]] Vec3 radiosity_of(const Mesh& mesh, const SurfacePoint& at, const Vec3& irradiance);

/// Gathers the light of the texels that are not covered, row after row until check() ends it.
[[nodiscard]] GatheredLightmap gather_texels(const Mesh& mesh, const Tracer& tracer,
                                             const SurfaceLight& light, const TexelMap& texels,
                                             const std::vector<bool>& covered,
                                             const LightmapOptions& options,
                                             const Workers& workers);

/// Gives the rows that are not finished the light that patches send or receive.
void complete_by_patches(GatheredLightmap& lightmap, const Mesh& mesh, const SurfaceLight& light,
                         const TexelMap& texels, Bake bake, const Workers& workers);

/// Fills unknown texels from the nearest known ones: covered ones of a chart from the same chart,
/// and up to `margin` texels around charts.
void fill_texels(GatheredLightmap& lightmap, const TexelMap& texels, int margin);

} // namespace hemilux
