#pragma once
// Corners of the plane in a tree that finds one inside a triangle, while corners are left out and
// come back.

#include "geometry/vector.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class CornerTree {
  public:
    /// Builds the tree of the corners with these numbers, all of which are there. Takes O(n log n)
    /// time.
    void build(std::span<const Vec2> corners, std::vector<std::uint32_t> numbers);
    void clear();
    /// Leaves the corner out or brings it back. Corners other than those of build() are never
    /// there. Takes O(log n) time.
    void set(std::uint32_t number, bool is_there);

    /// Returns whether a corner that is there lies in the counter-clockwise triangle or on its
    /// border, up to `rounding`. Those at the very place of a corner of the triangle do not count.
    /// Most triangles of a polygon are small, or hold some corner, and take O(log n) time. Slender
    /// ones along rows of corners take longer.
    [[nodiscard]] bool any_inside(const std::array<Vec2, 3>& triangle, double rounding) const;

    /// Returns how many nodes any_inside() has visited since this object was made.
    [[nodiscard]] std::uint64_t visits() const { return visits_; }

  private:
    static constexpr std::size_t corners_per_leaf = 8;
    struct Node {
        Vec2 low, high;
        std::uint32_t begin, end; ///< range of numbers_
        std::uint32_t there;      ///< number of these that are there
    };
    void build_node(std::size_t node, std::size_t begin, std::size_t end);
    [[nodiscard]] bool search(std::size_t node, const std::array<Vec2, 3>& triangle,
                              double rounding) const;

    std::span<const Vec2> corners_;
    std::vector<std::uint32_t> numbers_;
    std::vector<Node> nodes_;         ///< children of k: 2 k + 1, 2 k + 2
    std::vector<std::uint32_t> leaf_; ///< leaf of each corner, or none
    std::vector<std::uint8_t> there_; ///< marks by corner
    mutable std::uint64_t visits_ = 0;
};

} // namespace hemilux
