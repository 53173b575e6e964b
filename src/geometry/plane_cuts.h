#pragma once
// Convex pieces in a plane, divided by lines into groups of which few have anything in common.
// Boxes do this for most things. Lines do it where boxes all lie over each other, as those of
// slivers around a point do.

#include "geometry/flat_polygon.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace hemilux {

/// A facet, or the part of one that lies in the group.
struct PlanePiece {
    std::uint32_t facet;
    FlatPolygon outline;
};

/// Returns what lies left and right of a line along an edge of one piece. A piece that crosses the
/// line is cut in two, or goes to both sides as a whole where it has many corners. Two pieces that
/// have an area in common have it on one side at least. n disjoint pieces become O(n log n) by such
/// cuts (binary space partition; Paterson and Yao 1990). The result is empty where no line that was
/// tried leaves fewer on each side. Coordinates lie within [-1,1]^2. O(n).
[[nodiscard]] std::optional<std::array<std::vector<PlanePiece>, 2>>
cut_in_two(const std::vector<PlanePiece>& pieces);

} // namespace hemilux
