#pragma once
// Convex polygons in a plane with two coordinates, and what two of them have in common.

#include "geometry/vector.h"

#include <array>
#include <cstddef>

namespace hemilux {

struct Line {
    Vec2 from{0.0}, along{0.0};

    /// Returns the distance to the left, negative on the right side, times the length of `along`.
    [[nodiscard]] double left_distance(const Vec2& point) const {
        return cross(along, point - from);
    }
    [[nodiscard]] Line reversed() const { return {from, -along}; }
};

/// A convex polygon, counter-clockwise. It has up to eight corners, which is what two convex quads
/// can have in common.
struct FlatPolygon {
    std::array<Vec2, 8> corner{};
    std::size_t size = 0;

    /// Adds a corner. Rounding errors may ask for more corners than there is room for; those are
    /// left out, as their neighbours serve as well.
    void add(const Vec2& point) {
        if (size < corner.size())
            corner[size++] = point;
    }
    [[nodiscard]] double area() const;
    /// Returns the edge from a corner to the next; the inside is on its left.
    [[nodiscard]] Line edge(std::size_t i) const {
        return {corner[i], corner[i + 1 < size ? i + 1 : 0] - corner[i]};
    }
};

/// Returns whether an edge of one of them has the other on its outer side, up to this distance.
/// Touching neighbours are apart. O(n^2), no square root.
[[nodiscard]] bool are_apart(const FlatPolygon& a, const FlatPolygon& b, double distance);

/// Returns what lies left of a line, which has at most one corner more.
[[nodiscard]] FlatPolygon left_part(const FlatPolygon& shape, const Line& line);

/// Returns the polygon that both cover, without area where there is none (Sutherland and Hodgman
/// 1974). Each has at most four corners.
[[nodiscard]] FlatPolygon common_part(const FlatPolygon& a, const FlatPolygon& b);

} // namespace hemilux
