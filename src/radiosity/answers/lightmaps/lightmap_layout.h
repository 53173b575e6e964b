#pragma once
// Where surfaces lie in a lightmap.

#include "radiosity/answers/lightmaps/texel_map.h"

#include <span>
#include <string>
#include <vector>

namespace hemilux {

class Tracer;
struct Solution;

/// The places of surfaces in a lightmap. What `normals` refers to lives as long as it is used.
struct LightmapLayout {
    std::vector<PlacedTriangle> triangles; ///< places in texels
    int size = 0;                          ///< texels along a side
    int margin = 0;                        ///< texels around charts that are filled
    /// By facet; empty: texels have those of their facets.
    std::span<const CornerNormals> normals = {};
};

/// The layout of a lightmap of an object of this name or, without one, of all.
struct NamedLayout {
    std::string object;
    LightmapLayout layout;
};

/// Returns the texels of a layout, whose triangles show these sides. Both must outlive it.
[[nodiscard]] TexelMap texels_of(const LightmapLayout& layout,
                                 std::vector<PlacedTriangle> triangles, const Mesh& mesh,
                                 const Tracer& tracer);

/// Lets the triangles of each chart show the brighter side of two-sided facets, by the light of the
/// patches: a place in a lightmap has one light, and viewers show it on both sides.
void show_brighter_sides(const Mesh& mesh, const Solution& solution,
                         std::vector<PlacedTriangle>& triangles);

} // namespace hemilux
