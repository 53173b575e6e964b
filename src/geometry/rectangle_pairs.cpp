#include "geometry/rectangle_pairs.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace hemilux {
namespace {

struct Meet {
    const std::function<bool(std::uint32_t, std::uint32_t)>& call;
    std::size_t left; ///< comparisons
};

/// A half-open part of the plane.
struct Part {
    Vec2 low{-std::numeric_limits<double>::infinity()};
    Vec2 high{std::numeric_limits<double>::infinity()};
};

bool overlap(const Rectangle& a, const Rectangle& b) {
    return a.low.x < b.high.x && b.low.x < a.high.x && a.low.y < b.high.y && b.low.y < a.high.y;
}

/// A pair may be in several parts; it belongs to that in which its common rectangle begins.
bool belongs_to(const Rectangle& a, const Rectangle& b, const Part& part) {
    const Vec2 begin = glm::max(a.low, b.low);
    return begin.x >= part.low.x && begin.x < part.high.x && begin.y >= part.low.y &&
           begin.y < part.high.y;
}

bool compare_all(const std::vector<Rectangle>& rectangles, const Part& part, Meet& meet) {
    for (std::size_t i = 1; i < rectangles.size(); ++i) {
        if (meet.left < i)
            return false;
        meet.left -= i;
        for (std::size_t j = 0; j < i; ++j) {
            const Rectangle &a = rectangles[i], &b = rectangles[j];
            if (overlap(a, b) && belongs_to(a, b, part) && !meet.call(a.index, b.index))
                return false;
        }
    }
    return true;
}

bool are_of_one_set(const std::vector<Rectangle>& rectangles) {
    return std::ranges::all_of(rectangles,
                               [&](const Rectangle& r) { return r.set == rectangles[0].set; });
}

/// About half of the rectangles begin below; tiles are cut between each other.
double place_to_cut(const std::vector<Rectangle>& rectangles, int axis) {
    std::array<double, 63> sample;
    const std::size_t stride = rectangles.size() / sample.size();
    for (std::size_t k = 0; k < sample.size(); ++k)
        sample[k] = rectangles[k * stride].low[axis];
    const auto middle = sample.begin() + sample.size() / 2;
    std::ranges::nth_element(sample, middle);
    return *middle;
}

struct Halves {
    std::vector<Rectangle> half[2];
    Part part[2];
    /// Not where most rectangles are in both.
    [[nodiscard]] bool are_smaller_than(std::size_t whole) const {
        return 8 * std::max(half[0].size(), half[1].size()) < 7 * whole;
    }
};

Halves halve(const std::vector<Rectangle>& rectangles, const Part& part, int axis) {
    Halves halves{.half = {}, .part = {part, part}};
    const double cut = place_to_cut(rectangles, axis);
    for (std::vector<Rectangle>& half : halves.half)
        half.reserve(rectangles.size() * 5 / 8);
    halves.part[0].high[axis] = halves.part[1].low[axis] = cut;
    for (const Rectangle& r : rectangles) {
        if (r.low[axis] < cut)
            halves.half[0].push_back(r);
        if (r.high[axis] > cut)
            halves.half[1].push_back(r);
    }
    return halves;
}

bool search(std::vector<Rectangle> rectangles, const Part& part, int axis, Meet& meet) {
    constexpr std::size_t few = 64;
    if (rectangles.size() < few)
        return compare_all(rectangles, part, meet);
    Halves halves = halve(rectangles, part, axis);
    if (!halves.are_smaller_than(rectangles.size())) {
        axis = 1 - axis;
        halves = halve(rectangles, part, axis);
        if (!halves.are_smaller_than(rectangles.size()))
            return are_of_one_set(rectangles) || compare_all(rectangles, part, meet);
    }
    rectangles = {};
    return search(std::move(halves.half[0]), halves.part[0], 1 - axis, meet) &&
           search(std::move(halves.half[1]), halves.part[1], 1 - axis, meet);
}

} // namespace

bool for_each_overlap(std::vector<Rectangle> rectangles,
                      const std::function<bool(std::uint32_t, std::uint32_t)>& meet,
                      std::size_t most) {
    Meet counted{meet, most};
    return search(std::move(rectangles), {}, 0, counted);
}

} // namespace hemilux
