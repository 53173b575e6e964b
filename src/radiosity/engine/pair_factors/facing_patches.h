#pragma once
// Which patches face a patch and are large and near enough to count, without a look at each: a tree
// of groups is asked, which boxes bound.

#include "geometry/box.h"
#include "radiosity/engine/pair_factors/free_exchange.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

namespace hemilux {

class FacingPatches {
  public:
    /// The faces, by patch, must outlive this.
    explicit FacingPatches(std::span<const FacePlane> faces);

    /// Calls use(j) for patches of higher index than i, in no order. Among them are all that rise
    /// above the plane of i and whose rough_exchange() is more than `share` of the smaller of the
    /// two areas.
    template <class Use>
    void for_each(std::uint32_t i, double share, const Use& use) const {
        const FacePlane& face = faces_[i];
        for (std::size_t k = 0; k < nodes_.size();) {
            const Node& node = nodes_[k];
            if (node.max_index <= i || is_below(node.box, face.plane) ||
                is_too_far(node, face, share)) {
                k = node.skip;
                continue;
            }
            for (std::uint32_t at = node.begin; at < node.end; ++at)
                if (order_[at] > i)
                    use(order_[at]);
            ++k;
        }
    }

  private:
    /// A group in preorder. Inner ones have no patches of their own.
    struct Node {
        Box box; ///< of corners
        double max_area;
        std::uint32_t max_index, begin, end, skip; ///< skip: the node after all below
    };
    void divide(std::uint32_t begin, std::uint32_t end);

    [[nodiscard]] static bool is_below(const Box& box, const Plane& plane) {
        const Vec3 centre = box.centre(), half = box.high - centre;
        return plane.height(centre) + glm::dot(half, glm::abs(plane.normal)) <= 0;
    }
    /// The rough exchange of two areas is at most their product over pi d^2.
    [[nodiscard]] static bool is_too_far(const Node& node, const FacePlane& face, double share) {
        const Vec3 d = face.centre - glm::clamp(face.centre, node.box.low, node.box.high);
        return std::max(face.area, node.max_area) <= share * std::numbers::pi * glm::dot(d, d);
    }

    std::span<const FacePlane> faces_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

} // namespace hemilux
