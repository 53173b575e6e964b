#pragma once
// The vectors of the whole library: double precision. Floats are found in trees of boxes only.

#include <glm/glm.hpp>

namespace hemilux {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;

/// The axis along which a vector is longest.
[[nodiscard]] inline int largest_axis(const Vec3& v) {
    const Vec3 size = glm::abs(v);
    return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

} // namespace hemilux
