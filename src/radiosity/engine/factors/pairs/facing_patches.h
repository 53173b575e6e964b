#pragma once
// Which patches face a patch and are large and near enough to count, without a look at each: a tree
// of groups is asked, each of patches that lie together and face about the same way.

#include "geometry/box.h"
#include "radiosity/engine/factors/pairs/free_exchange.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class FacingPatches {
  public:
    explicit FacingPatches(std::span<const FacePlane> faces);

    /// Calls use(j) for patches of higher index than i, in no order. Among them are all that do not
    /// turn away from i and whose exchange_bound() is more than `share` of the smaller of the two
    /// areas.
    template <class Use>
    void for_each(std::uint32_t i, double share, const Use& use) const {
        const FacePlane& face = faces_[i];
        for (std::size_t k = 0; k < nodes_.size();) {
            const Node& node = nodes_[k];
            if (node.max_index <= i || !(bound(node, face) > share)) {
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
        Box box;     ///< of corners
        Vec3 normal; ///< about that of all
        double turn; ///< the longest difference of a normal from it [-]
        double max_area, max_radius;
        std::uint32_t max_index, begin, end, skip; ///< skip: the node after all below
    };
    void divide(std::uint32_t begin, std::uint32_t end);
    [[nodiscard]] Node group_of(std::uint32_t begin, std::uint32_t end) const;

    /// Returns what no exchange_bound() of the face with a patch of the group is larger than, as a
    /// share of the smaller area; 0 where all turn away.
    [[nodiscard]] static double bound(const Node& node, const FacePlane& face);

    std::span<const FacePlane> faces_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

} // namespace hemilux
