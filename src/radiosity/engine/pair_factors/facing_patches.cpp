#include "radiosity/engine/view_factors/facing_patches.h"

#include <numeric>

namespace hemilux {
namespace {

constexpr std::uint32_t patches_of_leaf = 16;

} // namespace

FacingPatches::FacingPatches(std::span<const FacePlane> faces)
    : faces_(faces), order_(faces.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    if (!faces.empty())
        divide(0, static_cast<std::uint32_t>(faces.size()));
}

/// Adds the group of a part of the order, divided at the median along the longest side.
void FacingPatches::divide(std::uint32_t begin, std::uint32_t end) {
    Node node{.box = {}, .max_area = 0, .max_index = 0, .begin = begin, .end = begin, .skip = 0};
    Box centres;
    for (std::uint32_t at = begin; at < end; ++at) {
        const FacePlane& face = faces_[order_[at]];
        node.box.include(box_of(face.shape.corner));
        node.max_area = std::max(node.max_area, face.area);
        node.max_index = std::max(node.max_index, order_[at]);
        centres.include(face.centre);
    }
    const std::size_t own = nodes_.size();
    const bool is_leaf = end - begin <= patches_of_leaf;
    if (is_leaf)
        node.end = end;
    nodes_.push_back(node);
    if (!is_leaf) {
        const Vec3 extent = centres.extent();
        int axis = extent.x >= extent.y ? 0 : 1;
        if (extent.z > extent[axis])
            axis = 2;
        const std::uint32_t middle = begin + (end - begin) / 2;
        const auto at = [this](std::uint32_t place) {
            return order_.begin() + static_cast<std::ptrdiff_t>(place);
        };
        std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
            const double of_a = faces_[a].centre[axis], of_b = faces_[b].centre[axis];
            return of_a < of_b || (of_a == of_b && a < b);
        });
        divide(begin, middle);
        divide(middle, end);
    }
    nodes_[own].skip = static_cast<std::uint32_t>(nodes_.size());
}

} // namespace hemilux
