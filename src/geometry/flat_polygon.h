#pragma once
// Convex polygons in the plane of two coordinates, and what two of them have in common.

#include "geometry/vector.h"

#include <array>
#include <cstddef>

namespace hemilux {

/// Up to eight corners, which is what two convex quads can have in common; counter-clockwise.
struct FlatPolygon {
    std::array<Vec2, 8> corner{};
    std::size_t size = 0;

    /// Rounding errors may ask for more corners than there are; those beside them are as good.
    void add(const Vec2& point) {
        if (size < corner.size())
            corner[size++] = point;
    }
    [[nodiscard]] double area() const;
};

/// Whether an edge of one of them has the other on its outer side, but for this distance; touching
/// neighbours are apart. O(n^2), no square root.
[[nodiscard]] bool are_apart(const FlatPolygon& a, const FlatPolygon& b, double distance);

/// The polygon that both cover, without area where there is none (Sutherland and Hodgman 1974).
/// Each has at most four corners.
[[nodiscard]] FlatPolygon common_part(const FlatPolygon& a, const FlatPolygon& b);

} // namespace hemilux
