#pragma once
// The ways in which materials of a glTF file refer to its lightmap.

namespace hemilux {

enum class Binding {
    lit,      ///< unlit, coloured by a picture of textures times light; as another variant lightmap
    lightmap, ///< MOZ_lightmap: the picture is irradiance, linear, times `intensity`
    unlit,    ///< KHR_materials_unlit with the picture as base colour: what a screen shows
    occlusion, ///< occlusionTexture, which has the share of the sky that is not blocked
    texture    ///< texture and coordinates alone
};

} // namespace hemilux
