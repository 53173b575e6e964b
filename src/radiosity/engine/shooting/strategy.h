#pragma once
// A strategy allocates a patch's rays to the cells of its hemisphere. The stepwise shooting methods
// differ in nothing else: the loops of Compute Radiosity (paper section 5b) are the same.

#include "geometry/polygon.h"
#include "geometry/spherical_triangle.h"
#include "radiosity/engine/densities/cell_directions.h"
#include "radiosity/paper/hemisphere/hemisphere.h"
#include "radiosity/paper/solving/solver.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace hemilux {

/// The cells of a patch in their order, and N_tr / N_hemi of the paper as running sums. Each cell
/// is one of Hemisphere::cells(), or whole_hemisphere, or private. Of the patch's rays, cell k owns
/// those from rays_up_to[k - 1], or 0, to rays_up_to[k]; the last sum is 1, which is all rays. With
/// the rules as printed it need not be 1.
///
/// Every strategy is unbiased, however the rays are allocated, as long as each cell with power has
/// a positive share of them. This is because a ray carries the power of its cell, divided among the
/// cell's rays.
struct Allocation {
    std::span<const std::uint16_t> cells;
    std::span<const double> rays_up_to;

    [[nodiscard]] double rays(std::size_t k) const {
        return k > 0 ? rays_up_to[k] - rays_up_to[k - 1] : rays_up_to[0];
    }
};

/// The memory of an allocation.
struct AllocatedCells {
    std::vector<std::uint16_t> cells;
    std::vector<double> rays_up_to;

    void clear() { cells.clear(), rays_up_to.clear(); }
    /// Adds a cell and its share of the patch's rays.
    void add(std::uint16_t cell, double rays) {
        cells.push_back(cell);
        rays_up_to.push_back((rays_up_to.empty() ? 0 : rays_up_to.back()) + rays);
    }
    [[nodiscard]] Allocation view() const { return {cells, rays_up_to}; }
};

/// A cell that is not in the table which all patches share. It is made only when rays are shot into
/// it.
struct PrivateCell {
    double power; ///< its share of the patch's [-]
    SphericalTriangle shape;
    Polygon origins; ///< the part of the patch where its rays start
    /// This many of its rays, the first ones, go in given directions instead of random ones.
    std::uint32_t given = 0;
    std::array<Vec3, 3> direction{};
};

/// The cells of a strategy that are not in the shared table.
class PrivateCells {
  public:
    virtual ~PrivateCells() = default;
    /// Returns the shape and power of an allocated cell; empty if the cell is in the shared table.
    [[nodiscard]] virtual std::optional<PrivateCell> private_cell(std::uint32_t patch,
                                                                  std::uint16_t cell) const = 0;
};

class StepHook;

class Strategy {
  public:
    virtual ~Strategy() = default;
    /// Returns the cells of a patch, always in the same order. The result is a view of what is kept
    /// or of what is put into `memory`, and is valid until either changes. It may be called from
    /// several threads.
    [[nodiscard]] virtual Allocation allocate(std::uint32_t patch,
                                              AllocatedCells& memory) const = 0;
    /// Returns its part that changes from step to step (step_hook.h). If it has none, all steps are
    /// alike, and several are solved at the same time.
    [[nodiscard]] virtual StepHook* step_hook() { return nullptr; }
    /// Returns its private cells; nullptr if all that it allocates are in the shared table.
    [[nodiscard]] virtual const PrivateCells* private_cells() const { return nullptr; }

    /// Returns the number of density rays so far; a strategy may look between the steps too.
    [[nodiscard]] virtual std::uint64_t density_rays() const { return 0; }
    /// Returns how many more density rays there would be if all triangles were divided.
    [[nodiscard]] virtual std::uint64_t density_rays_spared() const { return 0; }
    /// Returns the memory of what it keeps of patches [bytes].
    [[nodiscard]] virtual std::uint64_t density_bytes() const { return 0; }
};

} // namespace hemilux
