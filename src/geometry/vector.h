#pragma once
// The vectors of the whole library: double precision. Only bounding boxes of the BVH are float.

#include <glm/glm.hpp>

namespace hemilux {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;

} // namespace hemilux
