#pragma once
// Finds the closed surfaces of a scene: sets of facets that hang together and of which two run
// along each edge, in opposite directions.

#include "bvh/intersect.h"
#include "geometry/box.h"
#include "geometry/vector.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hemilux {

/// Facets that hang together.
struct Surface {
    std::vector<std::uint32_t> facets;
    Box box;
    bool closed = true;
};

class DisjointSets;

/// Returns the facets of each set, in the order of their least ones.
[[nodiscard]] std::vector<Surface> facets_of_sets(const FacetSoup& soup, DisjointSets& sets);

struct ConnectedSurfaces {
    std::vector<Surface> all;
    std::vector<std::array<std::uint32_t, 2>> neighbours; ///< facets of one surface at one edge
};

/// Finds the surfaces that all facets belong to, each to one, in O(n log n) time. Where more than
/// two facets share an edge, those go together that face each other.
[[nodiscard]] ConnectedSurfaces find_surfaces(const FacetSoup& soup);

/// Returns the winding number of a closed surface at a point: how many times it lies around it with
/// its front towards it, less those with its back. `without` is a facet that does not count; for a
/// point on it the number is the mean of those on its two sides. Returns nothing where rounding
/// decides, as on the surface.
[[nodiscard]] std::optional<double> winding_number(const FacetSoup& soup, const Surface& surface,
                                                   const Vec3& point,
                                                   std::optional<std::uint32_t> without = {});

} // namespace hemilux
