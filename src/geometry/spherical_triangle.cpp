#include "geometry/spherical_triangle.h"

#include "geometry/elementary.h"
#include "geometry/polar_warp.h"

#include <algorithm>

namespace hemilux {
namespace {

/// Returns the unit normal of the plane of an edge; a x (b - a) stays accurate for short edges. It
/// is zero for an edge without length.
Vec3 edge_normal(const Vec3& a, const Vec3& b) {
    const Vec3 m = glm::cross(a, b - a);
    const double length = glm::length(m);
    return length > 0 ? m / length : Vec3(0.0);
}

} // namespace

SphericalTriangle::SphericalTriangle(const Vec3& a, const Vec3& b, const Vec3& c)
    : vertex_{a, b, c}, normal_{edge_normal(a, b), edge_normal(b, c), edge_normal(c, a)} {
    set_hull();
}

/// Returns the greatest height of an edge's projection in a direction. It lies at an end, or where
/// the great circle goes farthest that way, if the edge holds that point. Arcs of ellipses may
/// bulge beyond their chords.
double SphericalTriangle::reach(std::size_t edge, Vec2 towards) const {
    const Vec3 &a = vertex_[edge], &b = vertex_[(edge + 1) % 3], &normal = normal_[edge];
    const double ends = std::max(glm::dot(towards, Vec2(a)), glm::dot(towards, Vec2(b)));
    const Vec3 direction(towards, 0.0);
    const Vec3 farthest = direction - glm::dot(direction, normal) * normal;
    const bool between = glm::dot(glm::cross(normal, a), farthest) > 0 &&
                         glm::dot(glm::cross(normal, b), farthest) < 0;
    return between ? std::max(ends, glm::length(farthest)) : ends;
}

void SphericalTriangle::set_hull() {
    const auto reach_of_all = [&](Vec2 towards) {
        return std::max({reach(0, towards), reach(1, towards), reach(2, towards)});
    };
    hull_.corner = {-reach_of_all({-1, 0}), -reach_of_all({0, -1})};
    const Vec2 extent = Vec2(reach_of_all({1, 0}), reach_of_all({0, 1})) - hull_.corner;
    hull_.edge = {Vec2(extent.x, 0), Vec2(0, extent.y)};

    std::array<Vec2, 3> outward{}, corner{}; // of each chord; corner i lies before side i
    std::array<double, 3> height{};
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec2 chord = Vec2(vertex_[(i + 1) % 3]) - Vec2(vertex_[i]);
        outward[i] = {chord.y, -chord.x};
        height[i] = reach_of_all(outward[i]);
    }
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec2 &n = outward[(i + 2) % 3], &m = outward[i];
        const double h = height[(i + 2) % 3], k = height[i];
        corner[i] = Vec2(h * m.y - k * n.y, k * n.x - h * m.x) / cross(n, m);
    }
    const Vec2 first = corner[1] - corner[0], second = corner[2] - corner[0];
    const double area = 0.5 * cross(first, second);
    if (area > 0 && area < extent.x * extent.y) {
        hull_.corner = corner[0];
        hull_.edge = {first, second};
        hull_.is_half = true;
    }
}

/// Uses tan(omega / 2) = a . (b x c) / (1 + a.b + b.c + c.a), eq. 8. The triple product is written
/// with differences to stay accurate for small triangles.
double SphericalTriangle::solid_angle() const {
    const auto& [a, b, c] = vertex_;
    const double triple = glm::dot(a, glm::cross(b - a, c - a));
    const double rest = 1.0 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a);
    return 2.0 * elementary::atan2(triple, rest);
}

/// Returns half the sum of the edges' angles times the z of their planes' unit normals (Lambert
/// 1760).
double SphericalTriangle::projected_solid_angle() const {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 &a = vertex_[i], &b = vertex_[(i + 1) % 3];
        const double angle = elementary::atan2(glm::length(glm::cross(a, b - a)), glm::dot(a, b));
        sum += angle * normal_[i].z;
    }
    return 0.5 * sum;
}

Vec3 SphericalTriangle::sample_sliver(Vec2 u) const {
    if (const PolarWarp warp(vertex_[0], vertex_[1], vertex_[2]); warp.area() > 0)
        return warp.sample(u);
    const Vec3 edge = glm::mix(vertex_[1], vertex_[2], u.x);
    return glm::normalize(glm::mix(vertex_[0], edge, u.y));
}

} // namespace hemilux
