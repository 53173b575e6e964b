#include "geometry/polygon.h"

#include "geometry/polygon_sampler.h"

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

std::array<Polygon, 4> quarters_of(const Polygon& polygon) {
    const auto& [a, b, c, d] = polygon.corner;
    const Vec3 ab = (a + b) / 2.0, bc = (b + c) / 2.0, cd = (c + d) / 2.0, da = (d + a) / 2.0;
    const Vec3 ca = (c + a) / 2.0, o = (ab + cd) / 2.0;
    if (polygon.is_triangle())
        return {{{{a, ab, ca, ca}}, {{ab, b, bc, bc}}, {{ca, bc, c, c}}, {{ab, bc, ca, ca}}}};
    return {{{{a, ab, o, da}}, {{ab, b, bc, o}}, {{o, bc, c, cd}}, {{da, o, cd, d}}}};
}

Polygon part_of(const Polygon& polygon, std::size_t parts, std::size_t index) {
    const std::size_t below = parts / 4; // of each quarter
    return below == 0 ? polygon
                      : part_of(quarters_of(polygon)[index / below], below, index % below);
}

} // namespace hemilux
