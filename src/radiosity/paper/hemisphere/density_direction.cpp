#include "radiosity/paper/hemisphere/density_direction.h"

#include <algorithm>

namespace hemilux {

Vec3 density_direction(const Vec3& vertex) {
    constexpr double min_sine = 0.01; // sine of the elevation
    const bool pole = vertex.x == 0 && vertex.y == 0;
    return glm::normalize(Vec3(pole ? min_sine : vertex.x, vertex.y, std::max(vertex.z, min_sine)));
}

} // namespace hemilux
