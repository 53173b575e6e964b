#pragma once
// Divides ranges of triangles in two by the binned surface area heuristic.

#include "bvh/intersect.h"
#include "bvh/wide/four_floats.h"
#include "parallel/workers.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hemilux::wide {

/// A triangle's box. The fourth lanes hold its slot in two halves, as numbers, so that whole
/// vectors can be added without meeting a denormal.
struct Item {
    F4 low, high;

    Item(const Vec3& low_corner, const Vec3& high_corner, std::uint32_t slot);
    [[nodiscard]] std::uint32_t slot() const {
        return static_cast<std::uint32_t>(low.v[3]) | static_cast<std::uint32_t>(high.v[3]) << 16;
    }
    [[nodiscard]] F4 centre() const { return low + high; } ///< doubled
};

struct FloatBox {
    F4 low = F4::splat(std::numeric_limits<float>::infinity());
    F4 high = F4::splat(-std::numeric_limits<float>::infinity());

    void include(F4 l, F4 h) {
        low = min(low, l);
        high = max(high, h);
    }
    void include(const FloatBox& other) { include(other.low, other.high); }
    [[nodiscard]] float half_area() const {
        const auto d = (high - low).v;
        return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
    }
};

/// Consecutive items with the boxes of the items and of their centres.
struct Range {
    std::uint32_t begin = 0, end = 0;
    FloatBox box, centres;

    void include(const Item& item) {
        box.include(item.low, item.high);
        centres.include(item.centre(), item.centre());
    }
    [[nodiscard]] std::uint32_t size() const { return end - begin; }
};

/// The cost of a leaf of n triangles: each block of eight, or part of one, is one test.
[[nodiscard]] constexpr float blocks_of(std::uint32_t n) { return static_cast<float>((n + 7) / 8); }

[[nodiscard]] Range range_of(std::span<const Item> items, std::uint32_t begin, std::uint32_t end);

/// Divides a range of at least two items, which it reorders; into equal halves if `balanced`.
[[nodiscard]] std::array<Range, 2> divide(std::span<Item> items, const Range& range, bool balanced,
                                          const Workers& workers);

} // namespace hemilux::wide
