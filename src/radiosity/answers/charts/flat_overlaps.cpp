#include "radiosity/answers/charts/flat_overlaps.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>

namespace hemilux {
namespace {

/// Polygons overlap where they do by more than this share of the size of the smaller one.
constexpr double tolerance = 1e-4;

struct Range {
    double low = std::numeric_limits<double>::infinity(), high = -low;

    void add(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    [[nodiscard]] double length() const { return high - low; }
};

Range range_along(const LaidPolygon& polygon, const Vec2& axis) {
    Range range;
    for (const Vec2& corner : polygon.corner)
        range.add(glm::dot(corner, axis));
    return range;
}

/// Returns whether the normal of some edge of `of` parts the two (separating axis).
bool are_parted(const LaidPolygon& of, const LaidPolygon& other) {
    for (std::size_t c = 0; c < of.corner.size(); ++c) {
        const Vec2 edge = of.corner[(c + 1) % of.corner.size()] - of.corner[c];
        const double length = glm::length(edge);
        if (!(length > 0))
            continue;
        const Vec2 axis = Vec2(-edge.y, edge.x) / length;
        const Range a = range_along(of, axis), b = range_along(other, axis);
        const double common = std::min(a.high, b.high) - std::max(a.low, b.low);
        if (common <= tolerance * std::min(a.length(), b.length()) || !(a.length() > 0))
            return true;
    }
    return false;
}

/// The polygons along x, for a sweep that meets only those whose boxes overlap.
struct Box2 {
    Range x, y;
};

/// Calls visit(a, b) for pairs of polygons that lie over each other, a < b.
template <class Visit>
void for_each_overlap(std::span<const LaidPolygon> polygons, const Visit& visit) {
    std::vector<Box2> boxes(polygons.size());
    for (std::size_t k = 0; k < polygons.size(); ++k)
        for (const Vec2& corner : polygons[k].corner) {
            boxes[k].x.add(corner.x);
            boxes[k].y.add(corner.y);
        }
    std::vector<std::size_t> order(polygons.size()), open;
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t k) { return boxes[k].x.low; });
    for (const std::size_t next : order) {
        const Box2& box = boxes[next];
        std::erase_if(open, [&](std::size_t k) { return boxes[k].x.high <= box.x.low; });
        for (const std::size_t other : open)
            if (boxes[other].y.low < box.y.high && box.y.low < boxes[other].y.high &&
                lie_over(polygons[next], polygons[other]) &&
                !visit(std::min(next, other), std::max(next, other)))
                return;
        open.push_back(next);
    }
}

} // namespace

LaidPolygon LaidPolygon::of(const Polygon& polygon, const Vec3& x, const Vec3& y) {
    LaidPolygon flat{};
    for (std::size_t c = 0; c < flat.corner.size(); ++c)
        flat.corner[c] = {glm::dot(polygon.corner[c], x), glm::dot(polygon.corner[c], y)};
    return flat;
}

bool lie_over(const LaidPolygon& a, const LaidPolygon& b) {
    return !are_parted(a, b) && !are_parted(b, a);
}

std::optional<std::pair<std::size_t, std::size_t>>
find_flat_overlap(std::span<const LaidPolygon> polygons) {
    std::optional<std::pair<std::size_t, std::size_t>> found;
    for_each_overlap(polygons, [&](std::size_t a, std::size_t b) {
        found = {a, b};
        return false;
    });
    return found;
}

std::vector<bool> lie_over_earlier(std::span<const LaidPolygon> polygons) {
    std::map<std::size_t, std::vector<std::size_t>> earlier; // by polygon, those it lies over
    for_each_overlap(polygons, [&](std::size_t a, std::size_t b) {
        earlier[b].push_back(a);
        return true;
    });
    std::vector<bool> marks(polygons.size());
    for (const auto& [polygon, others] : earlier)
        marks[polygon] =
            std::ranges::any_of(others, [&](std::size_t other) { return !marks[other]; });
    return marks;
}

} // namespace hemilux
