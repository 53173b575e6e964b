#pragma once
// The subdivision of the hemisphere that all patches share (paper section 5a, figures 4 to 7): four
// octants, each divided at its edge midpoints into four, level by level.
//
// Directions are in a patch's own frame, z being its normal. "Equal" triangles of the paper differ
// in solid angle by a factor of up to 1.96, so true areas are kept (docs/paper/decisions.md, D3).

#include "geometry/spherical_triangle.h"

#include <array>
#include <cstdint>
#include <vector>

namespace hemilux {

class Hemisphere {
  public:
    static constexpr int max_depth = 5;

    /// One triangle of the subdivision.
    struct Cell {
        std::array<std::uint16_t, 3> vertex;   ///< counter-clockwise seen from outside
        std::array<std::uint16_t, 3> midpoint; ///< vertices halfway on edges 01, 12, 20
        std::uint16_t first_child; ///< the four children follow each other; 0 at the last level
        std::uint8_t level;
        double solid_angle;           ///< [sr]
        double projected_solid_angle; ///< [sr]; over pi: the share of a diffuse patch's power
        SphericalTriangle shape;
    };

    /// Throws std::invalid_argument unless 0 <= depth <= max_depth.
    explicit Hemisphere(int depth);

    [[nodiscard]] int depth() const { return depth_; }
    /// The roots come first, then level 1, level 2, ...
    [[nodiscard]] const std::vector<Cell>& cells() const { return cells_; }
    /// Returns unit vectors. Those of level 0 come first (the pole is vertex 0), then those that
    /// level 1 adds, ...
    [[nodiscard]] const std::vector<Vec3>& vertices() const { return vertices_; }
    /// Returns the triangle of the last level that holds a direction, z >= 0; if several meet
    /// there, one of them.
    [[nodiscard]] std::uint16_t leaf_at(const Vec3& direction) const;
    /// Returns the number of triangles up to level n, t = 4 (4^(n+1) - 1) / 3 (paper section 6).
    [[nodiscard]] static std::size_t cells_up_to(int level) {
        return 4 * ((std::size_t{1} << (2 * (level + 1))) - 1) / 3;
    }

  private:
    int depth_;
    std::vector<Vec3> vertices_;
    std::vector<Cell> cells_;
    /// The normals of the planes that cut off the children 0, 1 and 2 of each divided triangle.
    std::vector<std::array<Vec3, 3>> cuts_;
};

} // namespace hemilux
