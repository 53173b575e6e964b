#pragma once
// The vectors of the whole library have double precision. Floats are found in trees of boxes only.

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vector_relational.hpp>

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

/// Returns which of the six directions along the axes a vector follows most: twice its largest
/// axis, and one more where it points down it.
[[nodiscard]] inline unsigned main_direction(const Vec3& v) {
    const int axis = largest_axis(v);
    return 2 * static_cast<unsigned>(axis) + (v[axis] < 0 ? 1 : 0);
}

} // namespace hemilux
