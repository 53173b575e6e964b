#pragma once
// Finds the sides of facets that lie under others, in layers of facets in one plane
// (light/layers/layered_mesh.h). Between two layers there is no room for light but that of the two.

#include <cstdint>
#include <vector>

namespace hemilux {

class Mesh;

/// A side of a facet: 2 f for the front of facet f, 2 f + 1 for its back.
using FacetSide = std::uint32_t;

struct CoveredSide {
    FacetSide side;
    std::vector<FacetSide> faces; ///< the other sides that light can pass to
};

/// Finds the sides all of which one other facet covers, in their order. Where a scene has very many
/// facets none is found.
[[nodiscard]] std::vector<CoveredSide> find_covered_sides(const Mesh& mesh);

} // namespace hemilux
