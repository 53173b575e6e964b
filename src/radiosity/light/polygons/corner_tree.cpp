#include "radiosity/light/polygons/corner_tree.h"

#include "radiosity/light/polygons/planar_turn.h"

#include <algorithm>
#include <limits>

namespace hemilux {
namespace {

using Triangle = std::array<Vec2, 3>;

constexpr std::uint32_t no_leaf = std::numeric_limits<std::uint32_t>::max();

/// Returns whether all of the box lies behind one of the triangle's edges. The places behind an
/// edge, by more than rounding, form a convex set, so the box is in it where its corners are.
bool is_apart(const Vec2& low, const Vec2& high, const Triangle& t, double rounding) {
    const Vec2 least = glm::min(glm::min(t[0], t[1]), t[2]) - rounding;
    const Vec2 most = glm::max(glm::max(t[0], t[1]), t[2]) + rounding;
    if (low.x > most.x || low.y > most.y || high.x < least.x || high.y < least.y)
        return true;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec2 &a = t[k], &b = t[(k + 1) % 3];
        if (turn_at(a, b, low, rounding) < 0 && turn_at(a, b, high, rounding) < 0 &&
            turn_at(a, b, {low.x, high.y}, rounding) < 0 &&
            turn_at(a, b, {high.x, low.y}, rounding) < 0)
            return true;
    }
    return false;
}

bool is_inside(const Vec2& p, const Triangle& t, double rounding) {
    return p != t[0] && p != t[1] && p != t[2] && !is_apart(p, p, t, rounding);
}

} // namespace

void CornerTree::clear() {
    numbers_.clear();
    nodes_.clear();
    leaf_.clear();
    there_.clear();
}

void CornerTree::build(std::span<const Vec2> corners, std::vector<std::uint32_t> numbers) {
    clear();
    corners_ = corners;
    numbers_ = std::move(numbers);
    leaf_.assign(corners.size(), no_leaf);
    there_.assign(corners.size(), 1);
    if (!numbers_.empty())
        build_node(0, 0, numbers_.size());
}

void CornerTree::build_node(std::size_t node, std::size_t begin, std::size_t end) {
    if (node >= nodes_.size())
        nodes_.resize(node + 1);
    const std::span<std::uint32_t> own = std::span(numbers_).subspan(begin, end - begin);
    Vec2 low = corners_[own[0]], high = low;
    for (const std::uint32_t i : own) {
        low = glm::min(low, corners_[i]);
        high = glm::max(high, corners_[i]);
    }
    const auto count = static_cast<std::uint32_t>(own.size());
    nodes_[node] = {low, high, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end),
                    count};
    if (count <= corners_per_leaf) {
        for (const std::uint32_t i : own)
            leaf_[i] = static_cast<std::uint32_t>(node);
        return;
    }
    const int axis = high.x - low.x >= high.y - low.y ? 0 : 1;
    const auto middle = own.begin() + count / 2;
    std::nth_element(own.begin(), middle, own.end(), [&](std::uint32_t a, std::uint32_t b) {
        return corners_[a][axis] < corners_[b][axis];
    });
    build_node(2 * node + 1, begin, begin + count / 2);
    build_node(2 * node + 2, begin + count / 2, end);
}

void CornerTree::set(std::uint32_t number, bool is_there) {
    if (number >= leaf_.size() || leaf_[number] == no_leaf || there_[number] == is_there)
        return;
    there_[number] = is_there;
    for (std::size_t node = leaf_[number];; node = (node - 1) / 2) {
        is_there ? ++nodes_[node].there : --nodes_[node].there;
        if (node == 0)
            return;
    }
}

bool CornerTree::any_inside(const Triangle& triangle, double rounding) const {
    return !nodes_.empty() && search(0, triangle, rounding);
}

bool CornerTree::search(std::size_t index, const Triangle& triangle, double rounding) const {
    ++visits_;
    const Node& node = nodes_[index];
    if (node.there == 0 || is_apart(node.low, node.high, triangle, rounding))
        return false;
    if (node.end - node.begin > corners_per_leaf)
        return search(2 * index + 1, triangle, rounding) ||
               search(2 * index + 2, triangle, rounding);
    return std::any_of(
        numbers_.begin() + node.begin, numbers_.begin() + node.end,
        [&](std::uint32_t i) { return there_[i] && is_inside(corners_[i], triangle, rounding); });
}

} // namespace hemilux
