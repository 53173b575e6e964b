#pragma once
// A picture of surfaces as they are lit, over the charts of a lightmap: their colours, as fine as
// their textures, times the light of the lightmap. Viewers show it without any light of their own.

#include "radiosity/answers/images/image.h"
#include "radiosity/answers/lightmaps/texel_map.h"

#include <span>
#include <vector>

namespace hemilux {

class Workers;

struct LitPicture {
    Image light;              ///< what surfaces send [W/m2]
    Image emitted;            ///< what of it they emit; empty: nothing
    std::vector<float> cover; ///< what textures cover of what lies behind [-]; empty: all of it
};

/// Returns how many texels of textures there are for one of the lightmap, along a side [-]; 0
/// without textures. Places are in texels of the lightmap.
[[nodiscard]] double texture_density(const Mesh& mesh, std::span<const PlacedTriangle> triangles);

/// Returns the picture, `times` as fine as the lightmap, whose places the triangles have. Light is
/// interpolated between texels. Up to `margin` texels of the lightmap around charts are filled.
[[nodiscard]] LitPicture lit_picture(const Mesh& mesh, std::vector<PlacedTriangle> triangles,
                                     const Image& irradiance, int times, int margin,
                                     const Workers& workers);

} // namespace hemilux
