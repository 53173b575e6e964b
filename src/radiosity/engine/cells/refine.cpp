#include "radiosity/engine/cells/refine.h"

#include "radiosity/engine/cells/patch_cells.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <memory>

namespace hemilux {
namespace {

class Refiner {
  public:
    Refiner(const Mesh& mesh, std::span<const std::uint8_t> levels)
        : mesh_(mesh), before_(dynamic_cast<const CellTree*>(mesh.finer())), levels_(levels),
          cells_(std::make_shared<CellTree>(mesh.scene().facets.size())) {}

    std::vector<std::uint32_t> run(Mesh& mesh) {
        for (std::uint32_t f = 0; f < mesh.scene().facets.size(); ++f)
            refine_facet(f);
        mesh.take_finer(std::move(patches_), first_patch_, std::move(cells_));
        return std::move(parents_);
    }

  private:
    void refine_facet(std::uint32_t facet) {
        const std::uint32_t begin = mesh_.first_patch(facet), end = end_of(facet);
        first_patch_.push_back(static_cast<std::uint32_t>(patches_.size()));
        const auto levels = levels_.subspan(begin, end - begin);
        const bool had_cells = before_ && before_->divides(facet);
        if (!had_cells && std::ranges::all_of(levels, [](std::uint8_t n) { return n == 0; })) {
            for (std::uint32_t i = begin; i < end; ++i) {
                patches_.push_back(mesh_.patches()[i]);
                parents_.push_back(i);
            }
            return;
        }
        const std::uint32_t pieces = mesh_.pieces(facet).pieces();
        const std::uint32_t cell = cells_->add_pieces(facet, pieces);
        for (std::uint32_t q = 0; q < pieces; ++q)
            if (had_cells)
                refine_cell(cell + q, before_->first_cell(facet) + q, facet);
            else
                refine_leaf(cell + q, begin + q * sides(facet), facet);
    }

    void refine_cell(std::uint32_t cell, std::uint32_t cell_before, std::uint32_t facet) {
        const CellTree::Cell old = (*before_)[cell_before];
        if (old.cut == CellCut::leaf)
            return refine_leaf(cell, old.first, facet);
        const std::uint32_t count = old.cut == CellCut::four ? 4 : 2, first = cells_->add(count);
        (*cells_)[cell] = {first, old.cut};
        for (std::uint32_t q = 0; q < count; ++q)
            refine_cell(first + q, old.first + q, facet);
    }

    /// Divides the front patch `parent`, with its back where there is one.
    void refine_leaf(std::uint32_t cell, std::uint32_t parent, std::uint32_t facet) {
        const int levels =
            std::max(levels_[parent], levels_[parent + (mesh_.has_back(facet) ? 1 : 0)]);
        divide(cell, cell_shape(facet, mesh_.patches()[parent].shape), levels, parent, facet);
    }

    void divide(std::uint32_t cell, const CellShape& shape, int levels, std::uint32_t parent,
                std::uint32_t facet) {
        if (levels == 0) {
            (*cells_)[cell] = {static_cast<std::uint32_t>(patches_.size()), CellCut::leaf};
            for (std::uint32_t side = 0; side < sides(facet); ++side) {
                patches_.push_back(mesh_.patch_from(shape.polygon(), facet, side == 1));
                parents_.push_back(parent + side);
            }
            return;
        }
        const CellCut by = best_cut(shape);
        const std::vector<CellShape> pieces = cut(shape, by);
        const std::uint32_t first = cells_->add(static_cast<std::uint32_t>(pieces.size()));
        (*cells_)[cell] = {first, by};
        for (std::uint32_t q = 0; q < pieces.size(); ++q)
            divide(first + q, pieces[q], levels - 1, parent, facet);
    }

    /// Returns the shape, as a cell, of a piece that is a patch's front.
    [[nodiscard]] CellShape cell_shape(std::uint32_t facet, const Polygon& piece) const {
        const auto& p = piece.corner;
        const bool fan = mesh_.pieces(facet).is_fan();
        if (fan && piece.is_triangle()) // of the strip at the apex
            return {{p[0], p[1], p[2], p[0]}, false};
        return {p, !fan && piece.is_triangle()};
    }

    [[nodiscard]] std::uint32_t sides(std::uint32_t facet) const {
        return mesh_.has_back(facet) ? 2 : 1;
    }
    [[nodiscard]] std::uint32_t end_of(std::uint32_t facet) const {
        return facet + 1 < mesh_.scene().facets.size()
                   ? mesh_.first_patch(facet + 1)
                   : static_cast<std::uint32_t>(mesh_.patches().size());
    }

    const Mesh& mesh_;
    const CellTree* before_; ///< null where no piece is divided yet
    std::span<const std::uint8_t> levels_;
    std::shared_ptr<CellTree> cells_;
    std::vector<Patch> patches_;
    std::vector<std::uint32_t> first_patch_; ///< by facet
    std::vector<std::uint32_t> parents_;     ///< by new patch
};

} // namespace

std::vector<std::uint32_t> refine(Mesh& mesh, std::span<const std::uint8_t> levels) {
    return Refiner(mesh, levels).run(mesh);
}

} // namespace hemilux
