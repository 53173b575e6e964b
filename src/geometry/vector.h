#pragma once
// The vectors of the whole library have double precision. Floats are found in trees of boxes only.

#include <glm/glm.hpp>

namespace hemilux {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;

/// Returns twice the area of the triangle from the origin to a and b; positive where b is left of
/// a.
[[nodiscard]] inline double cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }

/// Returns the axis along which a vector is longest.
[[nodiscard]] inline int largest_axis(const Vec3& v) {
    const Vec3 size = glm::abs(v);
    return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

} // namespace hemilux
