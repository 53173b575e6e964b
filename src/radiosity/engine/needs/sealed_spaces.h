#pragma once
// Finds what closed surfaces keep apart: no light passes from one side of such a surface to the
// other.
//
// A closed surface is made of facets of which two run along each edge, in opposite directions. Its
// winding number at a point, which is the solid angle of its facets seen from their fronts, less
// that seen from their backs, over 4 pi, is whole and changes across a facet only. So along a ray
// it stays the same. A facet that does not pass through the surface has one such number all over
// each of its sides. Between sides whose numbers differ there is no light.

#include "geometry/vector.h"

#include <cstdint>
#include <vector>

namespace hemilux {

class Mesh;

class SealedSpaces {
  public:
    /// All is one space.
    SealedSpaces() = default;
    /// Finds the spaces of a mesh. In a scene of very many facets, or of very many surfaces that
    /// contain others, it finds one space only.
    explicit SealedSpaces(const Mesh& mesh);

    /// Returns the number of spaces.
    [[nodiscard]] std::uint32_t count() const { return count_; }
    /// Returns the space in front of a facet, or behind it.
    [[nodiscard]] std::uint32_t of(std::uint32_t facet, bool front) const {
        return of_side_.empty() ? 0 : of_side_[2 * std::size_t{facet} + (front ? 0 : 1)];
    }
    /// Returns the space of a light without extent, by its number in point_emitters_of().
    [[nodiscard]] std::uint32_t of_point_emitter(std::size_t emitter) const {
        return of_point_.empty() ? 0 : of_point_[emitter];
    }
    /// Returns whether light may pass from one space to another, in either direction. It may where
    /// it is not known which space a side is in: this relation is not transitive.
    [[nodiscard]] bool may_exchange(std::uint32_t a, std::uint32_t b) const {
        return count_ == 1 || exchange_[std::size_t{a} * count_ + b];
    }

  private:
    std::uint32_t count_ = 1;
    std::vector<std::uint32_t> of_side_, of_point_; ///< spaces; empty where there is one only
    std::vector<bool> exchange_;                    ///< by pair of spaces
};

} // namespace hemilux
