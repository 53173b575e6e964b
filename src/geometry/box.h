#pragma once
// An axis-aligned bounding box, in the unit of its points, which is empty until something is
// included.

#include "geometry/vector.h"

#include <limits>
#include <span>

namespace hemilux {

struct Box {
    Vec3 low{std::numeric_limits<double>::infinity()};
    Vec3 high{-std::numeric_limits<double>::infinity()};

    void include(const Vec3& point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    void include(const Box& other) {
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
    }
    [[nodiscard]] bool empty() const { return !(low.x <= high.x); }
    [[nodiscard]] Vec3 centre() const { return 0.5 * (low + high); }
    [[nodiscard]] Vec3 extent() const { return empty() ? Vec3(0.0) : high - low; }
    /// Half of the surface area, to which the probability of a random line's visit is proportional.
    [[nodiscard]] double half_area() const {
        const Vec3 d = extent();
        return d.x * d.y + d.y * d.z + d.z * d.x;
    }
};

/// Returns whether two boxes have a point in common: they overlap, or touch.
[[nodiscard]] inline bool meet(const Box& a, const Box& b) {
    return glm::all(glm::lessThanEqual(a.low, b.high)) &&
           glm::all(glm::lessThanEqual(b.low, a.high));
}

[[nodiscard]] inline Box box_of(std::span<const Vec3> points) {
    Box box;
    for (const Vec3& point : points)
        box.include(point);
    return box;
}

} // namespace hemilux
