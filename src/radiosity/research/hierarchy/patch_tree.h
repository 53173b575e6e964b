#pragma once
// Trees over patches, the elements of hierarchical radiosity (Hanrahan, Salzman and Aupperle 1991).
//
// There the patches of a scene are divided from above, as far as links need it. Here the mesh is
// given, so trees are built from below. The patches that lie in one plane with one material and one
// side are a root, which is halved across its longer side until one patch is left. So the walls of
// a room that a file has in many faces make few roots; a curved surface makes as many as it has
// facets.

#include "bvh/tracer.h"
#include "geometry/vector.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;

class PatchTree {
  public:
    /// Lengths and areas are in local units.
    struct Node {
        std::uint32_t begin, end;    ///< range of its patches, in order()
        std::uint32_t child = none;  ///< the first of two in a row; none where it is one patch
        Vec3 centre{0.0};            ///< centre of mass
        Vec3 normal{0.0};            ///< unit
        double area = 0, radius = 0; ///< radius: no point of it is further from the centre
        [[nodiscard]] bool is_patch() const { return child == none; }
    };

    explicit PatchTree(const Mesh& mesh);

    /// Returns the nodes, parents before their children.
    [[nodiscard]] std::span<const Node> nodes() const { return nodes_; }
    [[nodiscard]] const Node& operator[](std::uint32_t node) const { return nodes_[node]; }
    [[nodiscard]] std::span<const std::uint32_t> roots() const { return roots_; }
    /// Returns the patches in the order of the nodes: those of a node stand together.
    [[nodiscard]] std::span<const std::uint32_t> order() const { return order_; }
    [[nodiscard]] std::uint32_t patch(const Node& leaf) const { return order_[leaf.begin]; }

    /// Returns a patch of the node, with a probability in proportion to its area, for u uniform in
    /// [0,1); u becomes uniform again. The area must be above 0.
    [[nodiscard]] std::uint32_t sample(const Node& node, double& u) const;

    /// Computes the means over the nodes of a value by patch, weighted by area (Hanrahan: pull).
    void pull(std::span<const double> by_patch, std::span<double> by_node) const;
    /// Adds up sums from the roots down to the patches (Hanrahan: push).
    void push(std::span<double> by_node, std::span<double> by_patch) const;

  private:
    void divide(std::uint32_t node);
    void measure(Node& node) const;

    const Mesh& mesh_;
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> roots_, order_;
    std::vector<double> area_before_; ///< area of all patches before a place in order_
};

} // namespace hemilux
