#pragma once
// The vectors of the whole library: double precision. Floats are found in trees of boxes only.

#include <glm/glm.hpp>

namespace hemilux {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;

} // namespace hemilux
