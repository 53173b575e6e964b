#pragma once
// This finds out whether the edges of a polygon in the plane cross each other.

#include "geometry/vector.h"

#include <cstdint>
#include <optional>
#include <span>

namespace hemilux {

/// Returns whether a polygon of four or more corners crosses itself. Edges that only touch do not
/// cross. Coordinates may be wrong by `rounding`. The edges are sorted along the axis on which they
/// are shorter, so the usual time is far below the O(n^2) of the worst case. Pairs that are
/// compared are taken from `work`; the result is empty where it does not suffice.
[[nodiscard]] std::optional<bool> crosses_itself(std::span<const Vec2> corners, double rounding,
                                                 std::uint64_t& work);

} // namespace hemilux
