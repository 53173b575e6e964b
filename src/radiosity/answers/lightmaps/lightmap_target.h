#pragma once
// A lightmap as what light is learned for, and by what its error is judged.

#include "radiosity/answers/lightmaps/texel_map.h"
#include "radiosity/answers/pictures/picture_error.h"
#include "radiosity/answers/vertices/baked_light.h"
#include "radiosity/light/cached_light/light_cache.h"
#include "radiosity/light/cached_light/surface_light.h"

#include <cstdint>
#include <vector>

namespace hemilux {

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
