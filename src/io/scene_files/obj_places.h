#pragma once
// Where the facets of an OBJ file lie in a lightmap: in the texture coordinates of the file, or in
// an atlas that becomes those of the same file.

#include "io/scene_files/lit_obj.h"
#include "radiosity/answers/charts/chart_regions.h"
#include "radiosity/answers/lightmaps/file_places.h"
#include "radiosity/answers/lightmaps/smooth_point.h"
#include "radiosity/answers/lightmaps/texel_map.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace hemilux {

/// Returns the places of these sides. `vt` counts upwards from the lower edge of the picture,
/// places downwards from the upper one. A face that names a vertex twice counts as one without.
[[nodiscard]] PlacesOfFile places_in_obj(const LitObj& file, const Mesh& mesh,
                                         std::span<const ChartSide> sides);

/// Returns the text of the file with the places of these triangles [0,1] as `vt`. A face whose
/// pieces lie in several charts is written as several faces.
[[nodiscard]] std::string text_with_atlas(const LitObj& file, const Mesh& mesh,
                                          std::span<const PlacedTriangle> triangles);

/// Returns the normals of the file at the corners of facets, by facet; those of a facet that looks
/// the other way in the scene are turned around.
[[nodiscard]] std::vector<CornerNormals> normals_of_obj(const LitObj& file, const Mesh& mesh);

} // namespace hemilux
