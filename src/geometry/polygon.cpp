#include "geometry/polygon.h"

#include <algorithm>
#include <cmath>

namespace hemilux {
namespace {

double triangle_area(const Vec3& a, const Vec3& b, const Vec3& c) {
    return 0.5 * glm::length(glm::cross(b - a, c - a));
}

/// Uniform point of a triangle; the square root turns equal shares of u.x into strips of equal
/// area.
Vec3 sample_triangle(const Vec3& a, const Vec3& b, const Vec3& c, Vec2 u) {
    const double strip = std::sqrt(u.x);
    return a + strip * ((b - a) + u.y * (c - b));
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

Vec3 Polygon::sample(Vec2 u) const {
    if (is_triangle())
        return sample_triangle(corner[0], corner[1], corner[2], u);
    // A parallelogram needs no choice between its halves.
    if (corner[1] - corner[0] == corner[2] - corner[3])
        return corner[0] + u.x * (corner[1] - corner[0]) + u.y * (corner[3] - corner[0]);
    const double a = triangle_area(corner[0], corner[1], corner[2]);
    const double b = triangle_area(corner[0], corner[2], corner[3]);
    const double split = a + b > 0 ? a / (a + b) : 1.0;
    if (u.x < split)
        return sample_triangle(corner[0], corner[1], corner[2], {u.x / split, u.y});
    return sample_triangle(corner[0], corner[2], corner[3], {(u.x - split) / (1.0 - split), u.y});
}

Polygon Polygon::flipped() const {
    if (is_triangle())
        return {{corner[0], corner[2], corner[1], corner[1]}};
    return {{corner[0], corner[3], corner[2], corner[1]}};
}

} // namespace hemilux
