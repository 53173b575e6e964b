#pragma once
// A convex polygon of a few corners without memory of its own: what planes leave of a patch.

#include "geometry/polygon.h"
#include "radiosity/engine/factors/pairs/exchange_area.h"

#include <array>
#include <cstddef>
#include <span>

namespace hemilux {

struct ConvexPart {
    std::array<Vec3, 28> corner;
    std::size_t size = 0; ///< 0: nothing is left

    /// Adds a corner; one more than there is room for, which only rounding can ask for, is left
    /// out.
    void add(const Vec3& point) {
        if (size < corner.size())
            corner[size++] = point;
    }
    [[nodiscard]] bool empty() const { return size == 0; }
    [[nodiscard]] std::span<const Vec3> corners() const { return {corner.data(), size}; }
    [[nodiscard]] const Vec3& next(std::size_t i) const { return corner[i + 1 < size ? i + 1 : 0]; }
    [[nodiscard]] Outline outline() const {
        return {corner.begin(), corner.begin() + static_cast<std::ptrdiff_t>(size)};
    }
};

[[nodiscard]] ConvexPart part_of(const Polygon& polygon);

/// Returns the part in front of a plane; empty where nothing rises above it by more than `rounding`
/// [length].
[[nodiscard]] ConvexPart in_front(const ConvexPart& part, const Plane& plane, double rounding);

} // namespace hemilux
