#pragma once
// The mesh with its light as vertex colours, for viewers and baking: PLY (Turk 1994), binary little
// endian.

#include "radiosity/answers/vertices/baked_light.h"

#include <string>

namespace hemilux {

/// The kinds of vertex colours.
enum class PlyColours {
    linear, ///< float red, green, blue: the light [W/m2]
    shown   ///< uchar red, green, blue: what a screen shows; then the luminance as float quality,
            ///< and the light as float radiosity_red, ..._green, ..._blue, or irradiance_red, ...
};

/// Writes vertices x, y, z (double, world units [m]) and their colours. Faces are the patches, in
/// the mesh's order; a patch on whose sides corners of others lie becomes several triangles.
/// Patches share a vertex where they share its light. Throws OutputError.
void write_ply(const std::string& path, const Mesh& mesh, const CornerClasses& classes,
               const VertexLight& light, PlyColours colours = PlyColours::linear);

} // namespace hemilux
