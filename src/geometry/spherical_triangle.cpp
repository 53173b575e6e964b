#include "geometry/spherical_triangle.h"

#include <algorithm>
#include <limits>

namespace hemilux {
namespace {

/// How far beyond an edge a direction still belongs to the triangle: the rounding error of points
/// computed to lie on the edge.
constexpr double edge_tolerance = 4 * std::numeric_limits<double>::epsilon();

/// Unit normal of the plane of an edge; a x (b - a) stays accurate for short edges. Zero for an
/// edge without length.
Vec3 edge_normal(const Vec3& a, const Vec3& b) {
    const Vec3 m = glm::cross(a, b - a);
    const double length = glm::length(m);
    return length > 0 ? m / length : Vec3(0.0);
}

} // namespace

SphericalTriangle::SphericalTriangle(const Vec3& a, const Vec3& b, const Vec3& c)
    : vertex_{a, b, c}, normal_{edge_normal(a, b), edge_normal(b, c), edge_normal(c, a)},
      box_low_(a), box_extent_(a), warp_(a, b, c) {
    for (std::size_t i = 0; i < 3; ++i)
        include_in_box(vertex_[i], vertex_[(i + 1) % 3], normal_[i]);
    box_extent_ -= box_low_; // until here it was the upper corner
}

/// The projected edge is an arc of an ellipse, which may bulge beyond its ends: where the tangent's
/// x changes its sign between them, x has its extreme +-sqrt(1 - m_x^2); y likewise.
void SphericalTriangle::include_in_box(const Vec3& a, const Vec3& b, const Vec3& normal) {
    const Vec2 end(b);
    box_low_ = glm::min(box_low_, end);
    box_extent_ = glm::max(box_extent_, end);
    const Vec3 start_tangent = glm::cross(normal, a), end_tangent = glm::cross(normal, b);
    for (int axis = 0; axis < 2; ++axis) {
        if (!(start_tangent[axis] * end_tangent[axis] < 0))
            continue;
        const double extreme = std::sqrt(std::max(0.0, 1.0 - normal[axis] * normal[axis]));
        if (start_tangent[axis] > 0)
            box_extent_[axis] = std::max(box_extent_[axis], extreme);
        else
            box_low_[axis] = std::min(box_low_[axis], -extreme);
    }
}

/// tan(omega / 2) = a . (b x c) / (1 + a.b + b.c + c.a), eq. 8; the triple product is written with
/// differences to stay accurate for small triangles.
double SphericalTriangle::solid_angle() const {
    const auto& [a, b, c] = vertex_;
    const double triple = glm::dot(a, glm::cross(b - a, c - a));
    const double rest = 1.0 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a);
    return 2.0 * std::atan2(triple, rest);
}

/// Half the sum of the edges' angles times the z of their planes' unit normals (Lambert 1760).
double SphericalTriangle::projected_solid_angle() const {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 &a = vertex_[i], &b = vertex_[(i + 1) % 3];
        const double angle = std::atan2(glm::length(glm::cross(a, b - a)), glm::dot(a, b));
        sum += angle * normal_[i].z;
    }
    return 0.5 * sum;
}

bool SphericalTriangle::contains(const Vec3& direction) const {
    return std::all_of(normal_.begin(), normal_.end(), [&](const Vec3& normal) {
        return glm::dot(normal, direction) >= -edge_tolerance;
    });
}

Vec3 SphericalTriangle::sample(Vec2 u) const {
    if (warp_.area() > 0)
        return warp_.sample(u);
    // Without area: some point between the vertices.
    const Vec3 edge = glm::mix(vertex_[1], vertex_[2], u.x);
    return glm::normalize(glm::mix(vertex_[0], edge, u.y));
}

double SphericalTriangle::density(const Vec3& direction) const {
    const double total = projected_solid_angle();
    return total > 0 && contains(direction) ? std::max(0.0, direction.z) / total : 0.0;
}

std::optional<Vec2> SphericalTriangle::inverse(const Vec3& direction) const {
    if (!(warp_.area() > 0) || !contains(direction))
        return std::nullopt;
    return warp_.inverse(direction);
}

} // namespace hemilux
