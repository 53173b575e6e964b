#pragma once
// The places of surfaces in texture coordinates that a file has, of whatever format.

#include "radiosity/answers/lightmaps/texel_map.h"

#include <cstdint>
#include <vector>

namespace hemilux {

struct PlacesOfFile {
    std::vector<PlacedTriangle> triangles; ///< places in [0,1]
    /// Groups of facets, each once: those without coordinates, and with places beyond [0,1].
    std::vector<std::uint32_t> without, outside;

    /// Adds a triangle of a facet of this group. One whose places have no area counts as without.
    void add(const PlacedTriangle& triangle, std::uint32_t group);
    void add_without(std::uint32_t group);
    /// Gives one chart to triangles that share an end both in the lightmap and on the surface.
    void join_charts(const Mesh& mesh);
};

} // namespace hemilux
