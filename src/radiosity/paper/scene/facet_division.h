#pragma once
// Cuts a facet into pieces whose edges are no longer than asked for, and finds which piece holds a
// point of it.
//
// A quad has rows x columns pieces by the bilinear map. A triangle that is about as wide as long
// has rows^2 triangles of its own shape. A narrow one has strips (its rows) parallel to its
// shortest edge. Lines through the opposite vertex, the apex, cut them into columns.

#include "bvh/tracer.h"
#include "geometry/polygon.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hemilux {

class FacetDivision {
  public:
    /// Cuts a facet until no edge is longer than `max_edge` [unit of the shape]; infinity gives one
    /// piece. Throws std::invalid_argument where that takes more pieces than `most`.
    FacetDivision(const Polygon& shape, double max_edge, std::size_t most);

    /// Returns the pieces of the shape that the constructor was given, in their order.
    [[nodiscard]] std::vector<Polygon> cut(const Polygon& shape) const;
    [[nodiscard]] std::uint32_t pieces() const { return rows_ * (similar_ ? rows_ : columns_); }
    /// Returns whether the pieces are triangles of the facet's own shape.
    [[nodiscard]] bool is_similar() const { return similar_; }
    /// Returns whether the strips of a triangle meet in the apex. Its pieces are then quads, except
    /// those of the first strip.
    [[nodiscard]] bool is_fan() const { return triangle_ && !similar_; }

    /// A piece, with the place of a point in it.
    struct Place {
        std::uint32_t piece;
        Vec2 inside; ///< coordinates [-], of the unit square or of its half x + y < 1
    };
    [[nodiscard]] Place place_of(const Hit& hit) const {
        return triangle_ ? place_in_triangle(hit) : place_in_quad(hit);
    }

  private:
    void divide_quad(const Polygon& shape, double max_edge);
    void divide_triangle(const Polygon& shape, double max_edge);
    [[nodiscard]] std::vector<Polygon> cut_quad(const Polygon& shape) const;
    [[nodiscard]] Place place_in_quad(const Hit& hit) const;
    [[nodiscard]] Place place_in_triangle(const Hit& hit) const;

    std::uint32_t rows_ = 1, columns_ = 1;
    bool triangle_;
    bool similar_ = false;
    std::uint8_t apex_ = 0; ///< triangle: which corner; of one piece the first
    /// For a quad, corner 0 - 1 + 2 - 3 in the basis of its edges at corner 0 [-].
    double g_x_ = 0, g_y_ = 0;
};

} // namespace hemilux
