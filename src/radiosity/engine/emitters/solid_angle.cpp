#include "radiosity/engine/emitters/solid_angle.h"

#include "geometry/elementary.h"
#include "geometry/numeric.h"

#include <algorithm>
#include <cmath>

namespace hemilux {
namespace {

/// The cross product of the edges keeps the digits that one of the ways to the corners would lose.
double solid_angle_of(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double volume = std::abs(glm::dot(a, glm::cross(b - a, c - a)));
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    const double along =
        la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
    return 2 * elementary::atan2(volume, along);
}

/// Returns the unit vector along the part of v that is perpendicular to the unit vector n.
Vec3 across(const Vec3& v, const Vec3& n) { return glm::normalize(v - glm::dot(v, n) * n); }

/// Returns a direction of the spherical triangle of this area. A meridian through b leaves the
/// share u.x of the area on the side of a; u.y chooses the place on it.
Vec3 sample_triangle(const Vec3& a, const Vec3& b, const Vec3& c, double area, Vec2 u) {
    const Vec3 to_b = across(b, a), to_c = across(c, a);
    const double cos_alpha = glm::dot(to_b, to_c), sin_alpha = glm::length(glm::cross(to_b, to_c));
    const Vec2 part = elementary::on_circle(u.x * area);      // of the area before the meridian
    const double s = part.y * cos_alpha - part.x * sin_alpha; // sin(part - alpha)
    const double t = part.x * cos_alpha + part.y * sin_alpha;
    const double p = t - cos_alpha, q = s + sin_alpha * glm::dot(a, b);
    const double cosine =
        std::clamp(((q * t - p * s) * cos_alpha - q) / ((q * s + p * t) * sin_alpha), -1.0, 1.0);
    const Vec3 end = cosine * a + safe_sqrt(1 - cosine * cosine) * to_c;
    const double z = 1 - u.y * (1 - glm::dot(end, b));
    return z * b + safe_sqrt(1 - z * z) * across(end, b);
}

} // namespace

SeenPolygon::SeenPolygon(const Vec3& point, const Polygon& polygon) {
    std::array<Vec3, 4> way;
    for (std::size_t k = 0; k < 4; ++k) {
        way[k] = polygon.corner[k] - point;
        to_corner_[k] = glm::normalize(way[k]);
    }
    solid_angle_[0] = solid_angle_of(way[0], way[1], way[2]);
    if (!polygon.is_triangle())
        solid_angle_[1] = solid_angle_of(way[0], way[2], way[3]);
}

Vec3 SeenPolygon::sample(Vec2 u) const {
    const double first = solid_angle_[0] / solid_angle();
    if (u.x < first)
        return sample_triangle(to_corner_[0], to_corner_[1], to_corner_[2], solid_angle_[0],
                               {u.x / first, u.y});
    return sample_triangle(to_corner_[0], to_corner_[2], to_corner_[3], solid_angle_[1],
                           {(u.x - first) / (1 - first), u.y});
}

} // namespace hemilux
