#include "radiosity/paper/hemisphere/density_direction.h"

#include <algorithm>

namespace hemilux {

Vec3 density_direction(const Vec3& vertex) {
    constexpr double least_sine = 0.01; // sine of the elevation
    const bool pole = vertex.x == 0 && vertex.y == 0;
    return glm::normalize(
        Vec3(pole ? least_sine : vertex.x, vertex.y, std::max(vertex.z, least_sine)));
}

} // namespace hemilux
