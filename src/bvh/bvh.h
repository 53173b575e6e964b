#pragma once
// Bounding volume hierarchy over triangles and quads: binary, built top-down by the surface area
// heuristic over bins (MacDonald and Booth 1990; Wald 2007).
//
// Facets keep their double coordinates; only the boxes are float. They are widened so that no
// rounding of a box or of a ray's origin loses a hit.

#include "bvh/intersect.h"
#include "bvh/quality.h"
#include "geometry/box.h"

#include <cstddef>
#include <vector>

namespace hemilux {

/// How the builder weighs its choices.
struct BvhOptions {
    double cost_visit = 1.0; ///< of a node's two boxes, relative to the test of one facet
    double cost_facet = 1.0;
    int bins = 16;              ///< candidates per axis; more: slightly better trees, longer builds
    std::uint32_t max_leaf = 8; ///< facets in a leaf at most
};

class Bvh final : public Tracer {
  public:
    /// Copies what it needs. Facets with a coordinate that is not finite are never hit.
    explicit Bvh(const FacetSoup& soup, const BvhOptions& options = {});

    [[nodiscard]] std::optional<Hit> closest(const Ray& ray) const override;
    [[nodiscard]] bool occluded(const Ray& ray, std::uint32_t target = none) const override;
    [[nodiscard]] std::uint32_t count(const Ray& ray) const override;

    /// The bytes are those of nodes, facets and vertices.
    [[nodiscard]] const BvhQuality& quality() const { return quality_; }

    /// An inner node with the boxes of both children: 64 bytes.
    struct alignas(64) Node {
        std::array<std::array<float, 2>, 3> low, high; ///< [axis][child]
        std::array<std::uint32_t, 2> first; ///< child's node, or first entry in order_ of a leaf
        std::array<std::uint32_t, 2> count; ///< facets of a leaf; `none`: the child is a node
    };

  private:
    /// The one traversal loop. Calls leaf(slot) for each slot of order_ whose box the ray meets
    /// before t_max, near children first; t_max may shrink meanwhile; leaf returns true to stop.
    template <class Leaf>
    void traverse(const Ray& ray, const double& t_max, Leaf&& leaf) const;

    std::vector<Vec3> vertices_;
    std::vector<FacetCorners> facets_; ///< in the order of the leaves
    std::vector<std::uint32_t> order_; ///< leaf slot -> facet as given
    std::vector<Node> nodes_;          ///< nodes_[0] is the root; empty when there is no facet
    Box bounds_;
    BvhQuality quality_;
};

} // namespace hemilux
