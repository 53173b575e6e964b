#pragma once
// Divides patches further: below the pieces of a facet, cells form a tree, as in quadtrees.
//
// A cell is the image of the unit square by a bilinear map, or of a triangle by an affine one. A
// square is cut in four or, where it is long, in two across its length. A triangle is cut in four
// of its own shape. Going down with the coordinates inside finds the leaf that a ray has hit.

#include "geometry/polygon.h"
#include "radiosity/paper/scene/mesh.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

/// The shape of a cell in coordinates (x, y) [-]. It is a square with corners at (0,0), (1,0),
/// (1,1), (0,1), or a triangle with corners at (0,0), (1,0), (0,1). The triangle's fourth corner
/// repeats the third.
struct CellShape {
    std::array<Vec3, 4> corner; ///< local units
    bool triangle;

    /// Returns the shape as a polygon. Two corners of a square may lie at the same point.
    [[nodiscard]] Polygon polygon() const;
};

/// Returns the point where a side is cut, with the same bytes whichever end comes first.
[[nodiscard]] inline Vec3 middle(const Vec3& a, const Vec3& b) { return .5 * (a + b); }

enum class CellCut : std::uint8_t { leaf, four, across_x, across_y };

/// Returns the cut after which the pieces are about as wide as long.
[[nodiscard]] CellCut best_cut(const CellShape& shape);
/// Returns the pieces, in the order of piece_at_point().
[[nodiscard]] std::vector<CellShape> cut(const CellShape& shape, CellCut by);
/// Returns which piece holds a point; its coordinates become those inside the piece. A point that
/// is outside by a rounding error belongs to the nearest piece.
[[nodiscard]] std::uint32_t piece_at_point(CellCut by, bool triangle, Vec2& at);

/// The cells of all facets.
class CellTree final : public FinerPatches {
  public:
    struct Cell {
        std::uint32_t first = 0; ///< the first of its pieces; of a leaf, the patch
        CellCut cut = CellCut::leaf;
    };
    explicit CellTree(std::size_t facets) : first_cell_(facets, none) {}

    /// Adds `count` consecutive cells and returns the index of the first.
    std::uint32_t add(std::uint32_t count);
    /// Adds a cell for each piece of a facet and returns the index of the first.
    std::uint32_t add_pieces(std::uint32_t facet, std::uint32_t pieces);
    [[nodiscard]] std::uint32_t first_cell(std::uint32_t facet) const { return first_cell_[facet]; }
    [[nodiscard]] Cell& operator[](std::uint32_t cell) { return cells_[cell]; }
    [[nodiscard]] const Cell& operator[](std::uint32_t cell) const { return cells_[cell]; }

    [[nodiscard]] bool divides(std::uint32_t facet) const override {
        return first_cell_[facet] != none;
    }
    [[nodiscard]] std::uint32_t patch_at(std::uint32_t facet, const FacetDivision& pieces,
                                         const FacetDivision::Place& place) const override;

  private:
    std::vector<Cell> cells_;
    std::vector<std::uint32_t> first_cell_; ///< by facet: that of its first piece; none: no cells
};

} // namespace hemilux
