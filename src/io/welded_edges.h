#pragma once
// How the facets of a scene meet at their edges.

#include "radiosity/scene.h"

#include <cstddef>

namespace hemilux {

struct EdgeCounts {
    std::size_t open = 0;        ///< edges of exactly one facet
    std::size_t nonmanifold = 0; ///< edges of three or more
};

/// Vertices at equal positions count as one.
[[nodiscard]] EdgeCounts count_edges(const Scene& scene);

} // namespace hemilux
