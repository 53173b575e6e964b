#pragma once
// Which cells the rays of a patch go to: systematic sampling.
//
// All patches and their cells own intervals of one line, one after the other, as long as their
// expected numbers of rays, and a ray stands at each whole number. As the line's origin is random,
// each cell gets its expected number on average, rounded up or down.

#include "radiosity/sampling/sampling_kernels.h"
#include "radiosity/shooting/strategy.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>

namespace hemilux {

/// std::floor for numbers of rays; compilers call a function for that.
[[nodiscard]] inline double whole_below(double rays) {
    return static_cast<double>(static_cast<std::int64_t>(rays));
}

/// The cells on the part of the line that a patch owns.
class SystematicCells {
  public:
    /// The patch owns the line from `before` to `after`.
    SystematicCells(const Allocation& allocation, double before, double after)
        : allocation_(allocation), before_(before), after_(after),
          rays_((after - before) / allocation.rays_up_to.back()) {}

    /// Calls found(cell, expected, low, high) for each cell with rays, in their order: expected,
    /// which is N_tr, and those from low + 1 to high.
    template <class Found>
    void for_each_cell(const Found& found) const {
        const double first = whole_below(before_);
        const auto rays = static_cast<std::size_t>(whole_below(after_) - first);
        if (rays <= most_looked_up)
            look_up(first, rays, found);
        else
            walk(first, found);
    }

  private:
    static constexpr std::size_t most_looked_up = 24;

    /// Goes through all cells.
    template <class Found>
    void walk(double low, const Found& found) const {
        for (std::size_t k = 0; k < allocation_.cells.size(); ++k) {
            const double high = whole_below(end_of(k));
            if (high > low)
                found(allocation_.cells[k], rays_ * allocation_.rays(k), low, high);
            low = high;
        }
    }

    /// Looks up the cell of each ray: late bounces have fewer rays than cells.
    template <class Found>
    void look_up(double first, std::size_t rays, const Found& found) const {
        std::array<float, most_looked_up> at;
        std::array<std::uint32_t, most_looked_up> cell;
        const std::span<const float> sums = allocation_.rays_up_to;
        const double scale = 1 / rays_, start = (first + 1 - before_) * scale;
        for (std::size_t k = 0; k < rays; ++k)
            at[k] = std::min(at_least(start + double(k) * scale), sums.back());
        sampling_kernels().count_below(sums.data(), sums.size(), rays, at.data(), cell.data());
        for (std::size_t k = 0, end; k < rays; k = end) {
            end = k + 1;
            while (end < rays && cell[end] == cell[k])
                ++end;
            found(allocation_.cells[cell[k]], rays_ * allocation_.rays(cell[k]), first + double(k),
                  first + double(end));
        }
    }

    /// The smallest float that is not below x > 0: what floats are less than it are less than x.
    [[nodiscard]] static float at_least(double x) {
        const float nearest = static_cast<float>(x);
        return std::bit_cast<float>(std::bit_cast<std::uint32_t>(nearest) +
                                    (nearest < x ? 1u : 0u));
    }

    /// The last cell with any share ends where the patch does; those after it own nothing.
    [[nodiscard]] double end_of(std::size_t cell) const {
        return allocation_.rays_up_to[cell] < allocation_.rays_up_to.back()
                   ? before_ + rays_ * allocation_.rays_up_to[cell]
                   : after_;
    }

    Allocation allocation_;
    double before_, after_;
    double rays_; ///< for one unit of the running sums
};

} // namespace hemilux
