#pragma once
// Convex pieces in a plane, divided by lines into groups of which few have anything in common: what
// boxes do for most things, where these all lie over each other, as those of slivers around a
// point.

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

/// What lies left and right of a line along an edge of one of them; what crosses it is cut in two,
/// or goes to both sides as a whole where it has many corners. Two that have an area in common have
/// it on one side at least. n disjoint pieces become O(n log n) by such cuts (binary space
/// partition; Paterson and Yao 1990). Empty where no line that was tried leaves fewer on each side.
/// Within [-1,1]^2. O(n).
[[nodiscard]] std::optional<std::array<std::vector<PlanePiece>, 2>>
cut_in_two(const std::vector<PlanePiece>& pieces);

} // namespace hemilux
