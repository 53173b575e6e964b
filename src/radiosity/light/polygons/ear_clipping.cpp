#include "radiosity/light/polygons/ear_clipping.h"

#include "radiosity/light/polygons/planar_turn.h"

#include <algorithm>

namespace hemilux {

void EarClipper::start(std::span<const Vec2> corners, double rounding) {
    const auto n = static_cast<std::uint32_t>(corners.size());
    corner_ = corners;
    straight_.clear();
    left_turns_.clear();
    rounding_ = rounding;
    node_.clear();
    blockers_.clear();
    queue_.clear();
    triangles_.clear();
    some_ = 0;
    left_ = n;
    ran_out_ = false;
    for (std::uint32_t i = 0; i < n; ++i)
        node_.push_back({i == 0 ? n - 1 : i - 1, i + 1 == n ? 0 : i + 1});
    for (std::uint32_t i = 0; i < n; ++i)
        find_turn(i);
    for (std::uint32_t i = 0; i < n && left_ > 2; ++i)
        if (!node_[i].cut && node_[i].turn == Turn::back)
            (void)unlink(i);
    std::vector<std::uint32_t> blockers;
    for (std::uint32_t i = 0; i < n; ++i)
        if (!node_[i].cut && node_[i].turn != Turn::left)
            blockers.push_back(i);
    blockers_.build(corners, std::move(blockers));
    for (std::uint32_t i = 0; i < n; ++i)
        if (!node_[i].cut)
            enqueue_if_ear(i);
}

std::span<const EarClipper::Triangle> EarClipper::clip(std::span<const Vec2> corners,
                                                       double rounding, std::uint64_t& work) {
    work_ = &work;
    start(corners, rounding);
    for (std::size_t front = 0; left_ >= 3;) {
        if (front == queue_.size()) {
            force_one();
            continue;
        }
        const Candidate candidate = queue_[front++];
        const Node& node = node_[candidate.corner];
        if (node.cut || node.version != candidate.version)
            continue;
        emit(candidate.corner);
        remove(candidate.corner);
    }
    return triangles_;
}

void EarClipper::find_turn(std::uint32_t i) {
    Node& node = node_[i];
    const Vec2 a = corner_[node.previous], b = corner_[i], c = corner_[node.next];
    const int turn = turn_at(a, b, c, rounding_);
    const bool goes_on = glm::dot(b - a, c - b) > 0;
    node.turn = turn > 0   ? Turn::left
                : turn < 0 ? Turn::right
                : goes_on  ? Turn::straight
                           : Turn::back;
    ++node.version;
    blockers_.set(i, !node.cut && node.turn != Turn::left);
    if (node.turn == Turn::straight)
        straight_.push_back(i);
    else if (node.turn == Turn::left)
        left_turns_.push_back(i);
}

/// Only corners that are not convex need be looked at: where any lies inside, the one farthest from
/// the diagonal is not convex. Those at the place of a corner of the triangle itself do not count;
/// polygons with a hole visit the ends of the bridge to it twice.
bool EarClipper::has_corner_inside(std::uint32_t i) {
    if (*work_ == 0)
        return false;
    const std::uint64_t before = blockers_.visits();
    const bool found = blockers_.any_inside(
        {corner_[node_[i].previous], corner_[i], corner_[node_[i].next]}, rounding_);
    *work_ -= std::min(*work_, blockers_.visits() - before);
    return found;
}

void EarClipper::enqueue_if_ear(std::uint32_t i) {
    if (node_[i].turn == Turn::left && !has_corner_inside(i))
        queue_.push_back({i, node_[i].version});
}

void EarClipper::emit(std::uint32_t i) {
    triangles_.push_back({node_[i].previous, i, node_[i].next});
}

void EarClipper::remove(std::uint32_t i) {
    for (const std::uint32_t neighbour : unlink(i))
        enqueue_if_ear(neighbour);
}

/// Cuts a corner from the polygon and returns its neighbours. Tips of spikes that come to light go
/// too: they have no width, but would hide what is beside them.
std::array<std::uint32_t, 2> EarClipper::unlink(std::uint32_t i) {
    for (;;) {
        const std::uint32_t previous = node_[i].previous, next = node_[i].next;
        node_[i].cut = true;
        blockers_.set(i, false);
        node_[previous].next = next;
        node_[next].previous = previous;
        some_ = next;
        --left_;
        find_turn(previous);
        find_turn(next);
        if (left_ > 2 && node_[previous].turn == Turn::back)
            i = previous;
        else if (left_ > 2 && node_[next].turn == Turn::back)
            i = next;
        else
            return {previous, next};
    }
}

/// Returns a corner with this turn: one that lies near the last that was cut, else any.
std::optional<std::uint32_t> EarClipper::find(Turn turn) {
    constexpr std::size_t near = 64;
    std::uint32_t i = some_;
    for (std::size_t k = 0; k < std::min(left_, near); ++k, i = node_[i].next)
        if (node_[i].turn == turn)
            return i;
    std::vector<std::uint32_t>& known = turn == Turn::straight ? straight_ : left_turns_;
    while (!known.empty() && !is_at(known.back(), turn))
        known.pop_back();
    return known.empty() ? std::nullopt : std::optional(known.back());
}

/// Cuts a corner where no ear is left. A straight corner goes without a triangle, as it has no
/// area. In a polygon that crosses itself any convex corner is cut, else any at all, with its
/// triangle turned to the front.
void EarClipper::force_one() {
    if (const auto i = find(Turn::straight))
        return remove(*i);
    ran_out_ = true;
    if (const auto i = find(Turn::left)) {
        emit(*i);
        return remove(*i);
    }
    emit(some_);
    std::swap(triangles_.back()[1], triangles_.back()[2]);
    remove(some_);
}

} // namespace hemilux
