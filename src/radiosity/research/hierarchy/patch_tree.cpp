#include "radiosity/research/hierarchy/patch_tree.h"

#include "bvh/median.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

namespace hemilux {
namespace {

/// The material, side and normal, in steps that hardly any direction of a model lies between. What
/// rounding keeps apart makes two roots of one, and no error.
using SideKey = std::array<std::int64_t, 5>;

SideKey side_of(const Patch& patch) {
    constexpr double steps = 1e4, offset = .3183;
    const auto rounded = [](double x) {
        return static_cast<std::int64_t>(std::llround(x * steps + offset));
    };
    const Vec3& n = patch.normal;
    return {patch.material, patch.back, rounded(n.x), rounded(n.y), rounded(n.z)};
}

/// Returns the patches of one side, plane by plane. Planes may be near to each other compared with
/// the scene, as under a far sun, but not compared with the patches.
std::vector<std::vector<std::uint32_t>> planes_of(std::span<const Patch> patches,
                                                  std::vector<std::uint32_t> of_side) {
    constexpr double rounding = 1e-6;
    const Vec3 normal = patches[of_side.front()].normal;
    const auto height = [&](std::uint32_t i) { return glm::dot(normal, patches[i].centre); };
    std::ranges::sort(of_side, [&](std::uint32_t a, std::uint32_t b) {
        const double x = height(a), y = height(b);
        return x < y || (x == y && a < b);
    });
    std::vector<std::vector<std::uint32_t>> planes;
    for (const std::uint32_t i : of_side) {
        if (planes.empty() ||
            !(height(i) - height(planes.back().back()) <= rounding * radius_of(patches[i])))
            planes.emplace_back();
        planes.back().push_back(i);
    }
    return planes;
}

} // namespace

PatchTree::PatchTree(const Mesh& mesh) : mesh_(mesh) {
    std::map<SideKey, std::vector<std::uint32_t>> sides;
    const auto patches = mesh.patches();
    for (std::uint32_t i = 0; i < patches.size(); ++i)
        sides[side_of(patches[i])].push_back(i);
    for (const auto& [key, of_side] : sides)
        for (const std::vector<std::uint32_t>& of_plane : planes_of(patches, of_side)) {
            roots_.push_back(static_cast<std::uint32_t>(nodes_.size()));
            const auto begin = static_cast<std::uint32_t>(order_.size());
            order_.insert(order_.end(), of_plane.begin(), of_plane.end());
            nodes_.push_back({begin, static_cast<std::uint32_t>(order_.size())});
            divide(roots_.back());
        }
    area_before_.push_back(0);
    for (const std::uint32_t patch : order_)
        area_before_.push_back(area_before_.back() + patches[patch].area);
}

void PatchTree::measure(Node& node) const {
    const auto patches = mesh_.patches();
    const auto of_node = std::span(order_).subspan(node.begin, node.end - node.begin);
    Vec3 weighted(0.0), plain(0.0);
    for (const std::uint32_t i : of_node) {
        node.area += patches[i].area;
        weighted += patches[i].area * patches[i].centre;
        plain += patches[i].centre / double(of_node.size());
    }
    node.centre = node.area > 0 ? weighted / node.area : plain;
    node.normal = patches[of_node.front()].normal;
    for (const std::uint32_t i : of_node)
        for (const Vec3& corner : patches[i].shape.corner)
            node.radius = std::max(node.radius, glm::distance(corner, node.centre));
}

void PatchTree::divide(std::uint32_t at) {
    measure(nodes_[at]);
    const std::uint32_t begin = nodes_[at].begin, end = nodes_[at].end;
    if (end - begin == 1)
        return;
    const auto own = std::span(order_).subspan(begin, end - begin);
    const std::size_t half = halve_at_median(
        own, [this](std::uint32_t patch) -> const Vec3& { return mesh_.patches()[patch].centre; });
    const std::uint32_t middle = begin + static_cast<std::uint32_t>(half);
    const auto child = static_cast<std::uint32_t>(nodes_.size());
    nodes_[at].child = child;
    nodes_.push_back({begin, middle});
    nodes_.push_back({middle, end});
    divide(child);
    divide(child + 1);
}

std::uint32_t PatchTree::sample(const Node& node, double& u) const {
    if (node.is_patch())
        return order_[node.begin];
    const double at =
        area_before_[node.begin] + u * (area_before_[node.end] - area_before_[node.begin]);
    const auto first = area_before_.begin() + node.begin + 1,
               last = area_before_.begin() + node.end;
    const auto slot =
        static_cast<std::uint32_t>(std::upper_bound(first, last, at) - area_before_.begin()) - 1;
    const double before = area_before_[slot], size = area_before_[slot + 1] - before;
    u = size > 0 ? std::clamp((at - before) / size, 0.0, 1 - 0x1p-53) : u;
    return order_[slot];
}

void PatchTree::pull(std::span<const double> by_patch, std::span<double> by_node) const {
    for (std::size_t k = nodes_.size(); k-- > 0;) {
        const Node& node = nodes_[k];
        if (node.is_patch()) {
            by_node[k] = by_patch[order_[node.begin]];
            continue;
        }
        const Node &one = nodes_[node.child], &other = nodes_[node.child + 1];
        by_node[k] = node.area > 0
                         ? (one.area * by_node[node.child] + other.area * by_node[node.child + 1]) /
                               node.area
                         : 0;
    }
}

void PatchTree::push(std::span<double> by_node, std::span<double> by_patch) const {
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
        const Node& node = nodes_[k];
        if (node.is_patch()) {
            by_patch[order_[node.begin]] = by_node[k];
            continue;
        }
        by_node[node.child] += by_node[k];
        by_node[node.child + 1] += by_node[k];
    }
}

} // namespace hemilux
