#pragma once
// A strategy allocates a patch's rays to the cells of its hemisphere. The stepwise shooting methods
// differ in nothing else: the loops of Compute Radiosity (paper section 5b) are the same.

#include "geometry/polygon.h"
#include "geometry/spherical_triangle.h"
#include "radiosity/hemisphere/cell_directions.h"
#include "radiosity/hemisphere/hemisphere.h"
#include "radiosity/solving/solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace hemilux {

/// The cells of a patch in their order, each of Hemisphere::cells(), or whole_hemisphere, or
/// private; and N_tr / N_hemi of the paper as running sums: of the patch's rays cell k owns those
/// from rays_up_to[k - 1], or 0, to rays_up_to[k], the last being all. With the rules as printed
/// that need not be 1.
///
/// Every strategy is unbiased, however the rays are allocated, as long as each cell with power has
/// a positive share of them: for a ray carries the power of its cell, divided among the cell's
/// rays. So floats do; many patches allocate anew in each bounce, and what is kept for that is to
/// be small.
struct Allocation {
    std::span<const std::uint16_t> cells;
    std::span<const float> rays_up_to;

    [[nodiscard]] double rays(std::size_t k) const {
        return k > 0 ? double(rays_up_to[k]) - double(rays_up_to[k - 1]) : double(rays_up_to[0]);
    }
};

/// The memory of an allocation.
struct AllocatedCells {
    std::vector<std::uint16_t> cells;
    std::vector<float> rays_up_to;

    void clear() { cells.clear(), rays_up_to.clear(), sum_ = 0; }
    /// Adds a cell and its share of the patch's rays. Rounding leaves no cell without rays.
    void add(std::uint16_t cell, double rays) {
        const float before = rays_up_to.empty() ? 0 : rays_up_to.back();
        const float after = static_cast<float>(sum_ += rays);
        cells.push_back(cell);
        rays_up_to.push_back(rays > 0 && !(after > before) ? std::nextafter(before, most)
                                                           : std::max(before, after));
    }
    [[nodiscard]] Allocation view() const { return {cells, rays_up_to}; }

  private:
    static constexpr float most = std::numeric_limits<float>::max();
    double sum_ = 0;
};

/// A cell that is not of the table which all patches share; made only when rays are shot into it.
struct PrivateCell {
    double power; ///< its share of the patch's [-]
    SphericalTriangle shape;
    Polygon origins; ///< the part of the patch where its rays start
    /// So many of its rays, the first ones, go in given directions and not by chance.
    std::uint32_t given = 0;
    std::array<Vec3, 3> direction{};
};

class Strategy {
  public:
    virtual ~Strategy() = default;
    /// Whether it allocates alike in all steps and learns nothing. Then several steps are solved at
    /// the same time, and prepare(), begin_step() and end_step() are not called.
    [[nodiscard]] virtual bool is_same_in_all_steps() const { return false; }
    /// Called before each step but the pilot, with estimates of the radiosity by patch [W/m2] and
    /// the power of a ray, mean of channels [W/m2 times area in local units]. Of a patch that gets
    /// more rays for a target it is as many times as large.
    virtual void prepare(std::span<const Vec3> /*radiosity*/, double /*ray_power*/) {}
    /// Called when a step begins, 0 being the first: allocations that follow belong to it.
    virtual void begin_step(std::uint64_t) {}
    /// Called when a step ends, unless it was interrupted: what was learned in that step is to be
    /// forgotten.
    virtual void end_step() {}
    /// A patch gets so many times the rays that its power alone would give it, each with as much
    /// less power. The factor is positive, the same throughout a step, and on average over all
    /// power about 1.
    [[nodiscard]] virtual double rays_for_power(std::uint32_t /*patch*/) const { return 1; }
    /// The cells of a patch, always in the same order: a view of what is kept or of what is put
    /// into `memory`, until either changes. Callable from several threads.
    [[nodiscard]] virtual Allocation allocate(std::uint32_t patch,
                                              AllocatedCells& memory) const = 0;
    /// Whether any cell that it allocates may be private.
    [[nodiscard]] virtual bool has_private_cells() const { return false; }
    /// The shape and power of a cell that was allocated; empty if the cell is in the shared table.
    [[nodiscard]] virtual std::optional<PrivateCell> private_cell(std::uint32_t /*patch*/,
                                                                  std::uint16_t /*cell*/) const {
        return std::nullopt;
    }

    /// Whether it learns in this step from what its rays hit.
    [[nodiscard]] virtual bool learns() const { return false; }
    /// Adds for each ray the cell of its receiver's hemisphere that it comes from, as `learn` takes
    /// it. Callable from several threads.
    virtual void find_arrivals(std::span<const Ray> /*rays*/,
                               std::span<const std::uint32_t> /*receivers*/,
                               std::vector<std::uint16_t>& /*added to*/) const {}
    /// Called in a fixed order with where the rays of a cell arrived (receivers.h).
    virtual void learn(std::uint32_t /*patch*/, std::uint16_t /*cell*/,
                       std::span<const std::uint32_t> /*receivers*/,
                       std::span<const std::uint16_t> /*arrivals*/) {}

    /// Saves and loads what was learned, as Solver does.
    virtual void save(StateWriter&) const {}
    virtual void load(StateReader&) {}

    /// So far: a strategy may look between the steps too.
    [[nodiscard]] virtual std::uint64_t density_rays() const { return 0; }
    /// How many more density rays there would be if all triangles were divided.
    [[nodiscard]] virtual std::uint64_t density_rays_spared() const { return 0; }
    /// The memory of what it keeps of patches.
    [[nodiscard]] virtual std::uint64_t density_bytes() const { return 0; }
};

} // namespace hemilux
