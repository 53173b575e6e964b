#pragma once
// Random shapes for the tests of sampling.

#include "geometry/polygon.h"
#include "geometry/spherical_triangle.h"
#include "geometry/vector.h"
#include "radiosity/paper/sampling/rng.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace hemilux::test {

[[nodiscard]] inline Vec2 random_pair(Rng& rng) {
    const double x = rng.uniform();
    return {x, rng.uniform()};
}

/// Uniform in the cube [-1,1]^3.
[[nodiscard]] inline Vec3 random_point(Rng& rng) {
    const double x = 2 * rng.uniform() - 1, y = 2 * rng.uniform() - 1;
    return {x, y, 2 * rng.uniform() - 1};
}

/// Uniform in solid angle over the sphere.
[[nodiscard]] inline Vec3 random_direction(Rng& rng) {
    for (;;) {
        const Vec3 v = random_point(rng);
        const double length = glm::length(v);
        if (length < 1 && length > 0.1)
            return v / length;
    }
}

/// The same over the upper hemisphere.
[[nodiscard]] inline Vec3 random_upper_direction(Rng& rng) {
    const Vec3 d = random_direction(rng);
    return {d.x, d.y, std::abs(d.z)};
}

/// Corners within `size` of each other, anywhere in the upper hemisphere, counter-clockwise seen
/// from outside and not a sliver.
[[nodiscard]] inline SphericalTriangle random_triangle(Rng& rng, double size = 2) {
    for (;;) {
        const Vec3 near = random_upper_direction(rng);
        Vec3 a = near, b = glm::normalize(near + size * random_point(rng)),
             c = glm::normalize(near + size * random_point(rng));
        const double triple = glm::dot(a, glm::cross(b - a, c - a));
        if (b.z < 0 || c.z < 0 || std::abs(triple) < 1e-3 * size * size)
            continue;
        if (triple < 0)
            std::swap(b, c);
        return {a, b, c};
    }
}

/// Whether a direction of the upper hemisphere lies inside; so do points computed to lie on an
/// edge, whatever their rounding errors.
[[nodiscard]] inline bool contains(const SphericalTriangle& triangle, const Vec3& direction) {
    constexpr double edge_tolerance = 4 * std::numeric_limits<double>::epsilon();
    return std::ranges::all_of(triangle.planes(), [&](const Vec3& normal) {
        return glm::dot(normal, direction) >= -edge_tolerance;
    });
}

/// All triangles after `levels` more divisions of one at its edge midpoints.
[[nodiscard]] inline std::vector<SphericalTriangle> divided(const SphericalTriangle& triangle,
                                                            int levels) {
    std::vector<SphericalTriangle> now{triangle};
    for (int level = 0; level < levels; ++level) {
        std::vector<SphericalTriangle> next;
        for (const SphericalTriangle& t : now) {
            const auto& [a, b, c] = t.vertices();
            const Vec3 ab = glm::normalize(a + b), bc = glm::normalize(b + c),
                       ca = glm::normalize(c + a);
            next.insert(next.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        now = std::move(next);
    }
    return now;
}

/// Parts of a triangle after so many divisions, and their exact shares of the cosine density.
struct Histogram {
    explicit Histogram(const SphericalTriangle& triangle, int levels = 2)
        : parts(divided(triangle, levels)) {
        for (const SphericalTriangle& part : parts)
            expected.push_back(part.projected_solid_angle() / triangle.projected_solid_angle());
    }
    /// The part that a direction lies in, or one past the last.
    [[nodiscard]] std::size_t cell(const Vec3& d) const {
        std::size_t i = 0;
        while (i < parts.size() && !contains(parts[i], d))
            ++i;
        return i;
    }
    std::vector<SphericalTriangle> parts;
    std::vector<double> expected;
};

} // namespace hemilux::test
