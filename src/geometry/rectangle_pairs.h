#pragma once
// All pairs of rectangles that overlap, among many.

#include "geometry/vector.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace hemilux {

struct Rectangle {
    Vec2 low, high;
    std::uint32_t index; ///< what it is reported as
    std::uint32_t set;   ///< a crowd of one set is not compared
};

/// Calls meet(a, b) with the indices of every pair whose insides overlap, once each, until it
/// answers false. The plane is halved until few rectangles are in a part: O(n log n + pairs). Where
/// halving does not part them all are compared with all, unless they are of one set. False where
/// meet() answered so, or where more than `most` comparisons were left.
bool for_each_overlap(std::vector<Rectangle> rectangles,
                      const std::function<bool(std::uint32_t, std::uint32_t)>& meet,
                      std::size_t most = std::numeric_limits<std::size_t>::max());

} // namespace hemilux
