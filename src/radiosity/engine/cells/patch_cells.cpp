#include "radiosity/engine/cells/patch_cells.h"

#include <algorithm>

namespace hemilux {
namespace {

CellShape triangle_of(const Vec3& a, const Vec3& b, const Vec3& c) { return {{a, b, c, c}, true}; }

/// Returns the half of [0, 1] in which x lies; x becomes its place in that half.
std::uint32_t half_at(double& x) {
    const bool upper = x >= .5;
    x = 2 * x - (upper ? 1 : 0);
    return upper ? 1 : 0;
}

} // namespace

Polygon CellShape::polygon() const {
    const auto& [a, b, c, d] = corner;
    if (!triangle && d == a) // the first strip of a fan
        return {{a, b, c, c}};
    return {corner};
}

CellCut best_cut(const CellShape& shape) {
    constexpr double long_for_its_width = 1.5;
    if (shape.triangle)
        return CellCut::four;
    const auto& [a, b, c, d] = shape.corner;
    const double along_x = std::max(glm::length(b - a), glm::length(c - d));
    const double along_y = std::max(glm::length(d - a), glm::length(c - b));
    return along_x > long_for_its_width * along_y   ? CellCut::across_x
           : along_y > long_for_its_width * along_x ? CellCut::across_y
                                                    : CellCut::four;
}

std::vector<CellShape> cut(const CellShape& shape, CellCut by) {
    const auto& [a, b, c, d] = shape.corner;
    const Vec3 ab = middle(a, b), bc = middle(b, c);
    if (shape.triangle) {
        const Vec3 ca = middle(c, a);
        return {triangle_of(a, ab, ca), triangle_of(ab, b, bc), triangle_of(ca, bc, c),
                triangle_of(bc, ca, ab)};
    }
    const Vec3 cd = middle(c, d), da = middle(d, a);
    switch (by) {
    case CellCut::across_x:
        return {{{a, ab, cd, d}, false}, {{ab, b, c, cd}, false}};
    case CellCut::across_y:
        return {{{a, b, bc, da}, false}, {{da, bc, c, d}, false}};
    case CellCut::four: {
        const Vec3 centre = middle(ab, cd);
        return {{{a, ab, centre, da}, false},
                {{ab, b, bc, centre}, false},
                {{da, centre, cd, d}, false},
                {{centre, bc, c, cd}, false}};
    }
    case CellCut::leaf:
        break;
    }
    return {shape};
}

std::uint32_t piece_at_point(CellCut by, bool triangle, Vec2& at) {
    if (!triangle) {
        const std::uint32_t right = by != CellCut::across_y ? half_at(at.x) : 0;
        const std::uint32_t upper = by != CellCut::across_x ? half_at(at.y) : 0;
        return by == CellCut::four ? right + 2 * upper : right + upper;
    }
    const double x = 2 * at.x, y = 2 * at.y;
    if (x >= 1) {
        at = {x - 1, y};
        return 1;
    }
    if (y >= 1) {
        at = {x, y - 1};
        return 2;
    }
    if (x + y < 1) {
        at = {x, y};
        return 0;
    }
    at = {1 - x, 1 - y}; // upside down, from the middle of the side bc on
    return 3;
}

std::uint32_t CellTree::add(std::uint32_t count) {
    const auto first = static_cast<std::uint32_t>(cells_.size());
    cells_.resize(cells_.size() + count);
    return first;
}

std::uint32_t CellTree::add_pieces(std::uint32_t facet, std::uint32_t pieces) {
    return first_cell_[facet] = add(pieces);
}

std::uint32_t CellTree::patch_at(std::uint32_t facet, const FacetDivision& pieces,
                                 const FacetDivision::Place& place) const {
    std::uint32_t cell = first_cell_[facet] + place.piece;
    Vec2 at = place.inside;
    while (cells_[cell].cut != CellCut::leaf)
        cell = cells_[cell].first + piece_at_point(cells_[cell].cut, pieces.is_similar(), at);
    return cells_[cell].first;
}

} // namespace hemilux
