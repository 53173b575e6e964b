#pragma once
// Builds the wide tree: top-down, eight children at a time, by the surface area heuristic over bins
// (Wald 2007). A node's range of triangles is divided in two again and again until there are eight
// parts. Each time the part with the largest surface is divided.
//
// The upper tree is built by one thread; the subtrees below it are jobs for all threads, cut by
// size alone, so that the tree does not depend on the number of threads.

#include "bvh/intersect.h"
#include "bvh/quality.h"
#include "bvh/wide/huge_array.h"
#include "bvh/wide/wide_layout.h"
#include "geometry/box.h"

namespace hemilux::wide {

struct Built {
    HugeArray<Node> nodes;            ///< none where there is no facet
    HugeArray<Leaf> leaves;           ///< none: nothing to hit
    Box bounds{Vec3(0.0), Vec3(0.0)}; ///< box of all facets, in the soup's units
    BvhQuality quality;
};

/// Returns the power of two by which the soup's coordinates are divided; no coordinate is larger.
[[nodiscard]] double size_of(const Box& bounds);

/// Builds the tree with so many `threads`, 0 being one per core. Facets with coordinates that are
/// not finite are left out.
[[nodiscard]] Built build(const FacetSoup& soup, unsigned threads);

} // namespace hemilux::wide
