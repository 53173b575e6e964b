#include "geometry/polygon.h"

#include "geometry/polygon_sampler.h"

#include <algorithm>
#include <cmath>

namespace hemilux {
namespace {

double triangle_area(const Vec3& a, const Vec3& b, const Vec3& c) {
    return 0.5 * glm::length(glm::cross(b - a, c - a));
}

} // namespace

Vec3 Polygon::centre() const {
    const Vec3 first = (corner[0] + corner[1] + corner[2]) / 3.0;
    if (is_triangle())
        return first;
    const Vec3 second = (corner[0] + corner[2] + corner[3]) / 3.0;
    const double a = triangle_area(corner[0], corner[1], corner[2]);
    const double b = triangle_area(corner[0], corner[2], corner[3]);
    return a + b > 0 ? (a * first + b * second) / (a + b) : first;
}

Vec3 Polygon::sample(Vec2 u) const { return PolygonSampler(*this).sample(u); }

Polygon Polygon::flipped() const {
    if (is_triangle())
        return {{corner[0], corner[2], corner[1], corner[1]}};
    return {{corner[0], corner[3], corner[2], corner[1]}};
}

} // namespace hemilux
