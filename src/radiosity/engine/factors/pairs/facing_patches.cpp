#include "radiosity/engine/factors/pairs/facing_patches.h"

#include <algorithm>
#include <numbers>
#include <numeric>

namespace hemilux {
namespace {

constexpr std::uint32_t patches_of_leaf = 16;

} // namespace

FacingPatches::FacingPatches(std::span<const FacePlane> faces)
    : faces_(faces), order_(faces.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    const auto way = [&](std::uint32_t i) { return main_direction(faces[i].plane.normal); };
    std::ranges::stable_sort(order_, {}, way);
    for (std::size_t begin = 0; begin < order_.size();) {
        std::size_t end = begin + 1;
        while (end < order_.size() && way(order_[end]) == way(order_[begin]))
            ++end;
        divide(static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end));
        begin = end;
    }
}

FacingPatches::Node FacingPatches::group_of(std::uint32_t begin, std::uint32_t end) const {
    Node node{};
    for (std::uint32_t at = begin; at < end; ++at) {
        const FacePlane& face = faces_[order_[at]];
        node.box.include(box_of(face.shape.corner));
        node.normal += face.plane.normal;
        node.max_area = std::max(node.max_area, face.area);
        node.max_radius = std::max(node.max_radius, face.radius);
        node.max_index = std::max(node.max_index, order_[at]);
    }
    node.normal = glm::normalize(node.normal); // not 0: all face along one axis
    for (std::uint32_t at = begin; at < end; ++at)
        node.turn =
            std::max(node.turn, glm::distance(faces_[order_[at]].plane.normal, node.normal));
    return node;
}

double FacingPatches::bound(const Node& node, const FacePlane& face) {
    const Vec3 half = .5 * node.box.extent(), d = node.box.centre() - face.centre;
    const double reach = node.max_radius + face.radius;
    const double of_group =
        glm::dot(d, face.plane.normal) + glm::dot(half, glm::abs(face.plane.normal));
    const double of_face = -glm::dot(d, node.normal) + glm::dot(half, glm::abs(node.normal)) +
                           node.turn * (glm::length(d) + glm::length(half));
    if (of_group + reach <= 0 || of_face + reach <= 0)
        return 0;
    const Vec3 between = glm::max(glm::abs(d) - half, Vec3(0.0));
    const double distance = glm::length(between) - reach;
    if (!(distance > 0))
        return 1;
    const double height_of_group = std::max(of_group, 0.0) + node.max_radius,
                 height_of_face = std::max(of_face, 0.0) + face.radius;
    return std::max(face.area, node.max_area) * std::min(height_of_group / distance, 1.0) *
           std::min(height_of_face / distance, 1.0) / (std::numbers::pi * distance * distance);
}

/// Adds the group of a part of the order, divided at the median along the longest side.
void FacingPatches::divide(std::uint32_t begin, std::uint32_t end) {
    Node node = group_of(begin, end);
    const std::size_t own = nodes_.size();
    const bool is_leaf = end - begin <= patches_of_leaf;
    node.begin = begin;
    node.end = is_leaf ? end : begin;
    nodes_.push_back(node);
    if (!is_leaf) {
        Box centres;
        for (std::uint32_t at = begin; at < end; ++at)
            centres.include(faces_[order_[at]].centre);
        const int axis = largest_axis(centres.extent());
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
