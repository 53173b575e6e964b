#pragma once
// Finds how the facets of a scene meet at their edges.

#include "bvh/intersect.h"
#include "geometry/vector.h"
#include "radiosity/paper/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

/// Hashes positions: equal positions have equal hashes, and -0 counts as 0.
struct PositionHash {
    [[nodiscard]] std::size_t operator()(const Vec3& p) const;
};

/// One side of a facet. Vertices in one place count as one.
struct Edge {
    std::uint64_t ends; ///< both vertices, the smaller one in the upper half
    std::uint32_t facet;
    bool forward; ///< the facet runs from the smaller vertex to the larger one
};

/// Returns the edges of all facets, except those without length. They are sorted by their ends,
/// then by facet, so that edges in one place are neighbours. `first` gives for each vertex the one
/// whose number stands for all in its place.
[[nodiscard]] std::vector<Edge> edges_of(std::span<const FacetCorners> facets,
                                         std::span<const std::uint32_t> first);
/// Returns the edges of a scene. Vertices at equal positions are in one place, and the first stands
/// for them.
[[nodiscard]] std::vector<Edge> welded_edges(const Scene& scene);

/// Calls visit(first, last) for each place: the range of the edges that lie there.
template <class Visit>
void for_each_place(const std::vector<Edge>& edges, const Visit& visit) {
    for (auto first = edges.begin(); first != edges.end();) {
        auto last = first;
        while (last != edges.end() && last->ends == first->ends)
            ++last;
        visit(first, last);
        first = last;
    }
}

struct EdgeCounts {
    std::size_t open = 0;        ///< edges of exactly one facet
    std::size_t nonmanifold = 0; ///< edges of three or more
};

[[nodiscard]] EdgeCounts count_edges(const Scene& scene);

} // namespace hemilux
