#pragma once
// A bounding volume hierarchy over triangles and quads: binary, built top-down by the surface area
// heuristic over bins (MacDonald and Booth 1990; Wald 2007).
//
// Facets keep their double coordinates; only the boxes are float. They are widened so that no
// rounding of a box or of a ray's origin loses a hit.

#include "bvh/intersect.h"
#include "geometry/box.h"

#include <cstddef>
#include <span>
#include <vector>

namespace hemilux {

class Bvh final : public Tracer {
  public:
    /// Copies what it needs. Facets with a coordinate that is not finite are never hit.
    explicit Bvh(const FacetSoup& soup);

    [[nodiscard]] std::optional<Hit> closest(const Ray& ray) const override;
    [[nodiscard]] bool occluded(const Ray& ray, std::uint32_t target = none) const override;
    [[nodiscard]] std::uint32_t count(const Ray& ray) const override;

    /// Refers to a node, or to a leaf of `count` facets from an entry of order_ on.
    struct Child {
        std::uint32_t first;
        std::uint32_t count; ///< `none`: a node
    };
    /// An inner node with the boxes of both children: 64 bytes.
    struct alignas(64) Node {
        std::array<std::array<float, 2>, 3> low, high; ///< [axis][child]
        std::array<Child, 2> child;
    };

    /// Returns the inner nodes; those that a node refers to come after it.
    [[nodiscard]] std::span<const Node> nodes() const { return nodes_; }
    [[nodiscard]] Child root() const { return root_; }
    /// Returns the box of all facets.
    [[nodiscard]] const Box& bounds() const { return bounds_; }
    /// Returns the facets of a leaf.
    [[nodiscard]] std::span<const std::uint32_t> facets_of(const Child& leaf) const {
        return std::span(order_).subspan(leaf.first, leaf.count);
    }

  private:
    /// Runs the one traversal loop. Calls leaf(slot) for each slot of order_ whose box the ray
    /// meets before t_max, near children first. t_max may shrink meanwhile; leaf returns true to
    /// stop.
    template <class Leaf>
    void traverse(const Ray& ray, const double& t_max, Leaf&& leaf) const;

    std::vector<Vec3> vertices_;
    std::vector<FacetCorners> facets_; ///< facets in the order of the leaves
    std::vector<std::uint32_t> order_; ///< leaf slot -> facet as given
    std::vector<Node> nodes_;
    Child root_;
    Box bounds_;
};

} // namespace hemilux
