#include "radiosity/research/guiding/patch_boxes.h"

#include "bvh/median.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>

namespace hemilux {

PatchBoxes::PatchBoxes(const Mesh& mesh) {
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i)
        if (mesh.patches()[i].area > 0)
            order_.push_back(i);
    nodes_.reserve(2 * order_.size());
    if (!order_.empty())
        build(mesh, 0, static_cast<std::uint32_t>(order_.size()));
}

void PatchBoxes::build(const Mesh& mesh, std::uint32_t first, std::uint32_t last) {
    const std::size_t at = nodes_.size();
    Box box;
    for (std::uint32_t k = first; k < last; ++k)
        box.include(box_of(mesh.patches()[order_[k]].shape.corner));
    nodes_.push_back({box, first, last, 0});
    if (last - first == 1)
        return;
    const std::uint32_t middle =
        first + static_cast<std::uint32_t>(halve_at_median(
                    std::span(order_).subspan(first, last - first),
                    [&](std::uint32_t patch) { return mesh.patches()[patch].centre; }));
    build(mesh, first, middle);
    nodes_[at].second = static_cast<std::uint32_t>(nodes_.size());
    build(mesh, middle, last);
}

} // namespace hemilux
