#pragma once
// Finds which of many convex polygons in a plane lie over each other.

#include "geometry/polygon.h"
#include "geometry/vector.h"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace hemilux {

/// A triangle, whose last two corners are the same, or a convex quad.
struct LaidPolygon {
    std::array<Vec2, 4> corner;

    /// Returns the projection of a polygon on two axes.
    [[nodiscard]] static LaidPolygon of(const Polygon& polygon, const Vec3& x, const Vec3& y);
};

/// Returns whether two polygons share more than a border, or than rounding makes of one.
[[nodiscard]] bool lie_over(const LaidPolygon& a, const LaidPolygon& b);

/// Returns two polygons that lie over each other, the smaller index first.
[[nodiscard]] std::optional<std::pair<std::size_t, std::size_t>>
find_flat_overlap(std::span<const LaidPolygon> polygons);

/// Returns marks of polygons that lie over one before them which has no mark.
[[nodiscard]] std::vector<bool> lie_over_earlier(std::span<const LaidPolygon> polygons);

} // namespace hemilux
