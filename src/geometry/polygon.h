#pragma once
// The two shapes of a scene, triangle and planar convex quad, under one type. So a quad is one
// surface everywhere: it is counted once, sampled once and intersected once.

#include "geometry/vector.h"

#include <array>
#include <cstdint>
#include <span>

namespace hemilux {

/// Corners of a triangle (corner[3] == corner[2]) or of a planar convex quad, counter-clockwise
/// seen from the front. Areas are in the square of their unit.
struct Polygon {
    std::array<Vec3, 4> corner{};

    [[nodiscard]] bool is_triangle() const { return corner[2] == corner[3]; }
    [[nodiscard]] int size() const { return is_triangle() ? 3 : 4; }

    /// Returns half the cross product of the diagonals, whose length is the area and whose
    /// direction is the front side.
    [[nodiscard]] Vec3 area_vector() const {
        return 0.5 * glm::cross(corner[2] - corner[0], corner[3] - corner[1]);
    }
    [[nodiscard]] double area() const { return glm::length(area_vector()); }
    /// Returns the unit normal of the front side; NaN for a polygon without area.
    [[nodiscard]] Vec3 normal() const { return glm::normalize(area_vector()); }
    /// Returns the centre of mass.
    [[nodiscard]] Vec3 centre() const;
    /// Returns a point uniform over the area for u uniform in [0,1)^2; keeps stratification of u.
    [[nodiscard]] Vec3 sample(Vec2 u) const;
    /// Returns the same polygon seen from behind.
    [[nodiscard]] Polygon flipped() const;
};

/// Divides at the midpoints of the edges: a quad into 2 x 2 quads, a triangle into four triangles
/// that are similar to it, the middle one last.
[[nodiscard]] std::array<Polygon, 4> quarters_of(const Polygon& polygon);

/// Returns one of 1, 4, 16 or more `parts`, which are quarters of quarters. The parts of one
/// quarter follow each other.
[[nodiscard]] Polygon part_of(const Polygon& polygon, std::size_t parts, std::size_t index);

/// Returns the polygon of a facet, by the indices of its corners.
[[nodiscard]] inline Polygon polygon_of(std::span<const Vec3> vertices,
                                        const std::array<std::uint32_t, 4>& corners) {
    return {
        {vertices[corners[0]], vertices[corners[1]], vertices[corners[2]], vertices[corners[3]]}};
}

} // namespace hemilux
