#pragma once
// Systematic sampling decides which cells the rays of a patch go to.
//
// All patches and their cells own intervals of one line, one after another, each as long as the
// expected number of rays. A ray stands at each whole number. As the line's origin is random, each
// cell gets its expected number on average, rounded up or down.

#include "radiosity/engine/sampling/sampling_kernels.h"
#include "radiosity/engine/shooting/strategy.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace hemilux {

/// Does what std::floor does for numbers of rays; compilers call a function for that.
[[nodiscard]] inline double whole_below(double rays) {
    return static_cast<double>(static_cast<std::int64_t>(rays));
}

/// The cells on the part of the line that a patch owns.
class SystematicCells {
  public:
    /// The patch owns the line from `before` to `after`.
    SystematicCells(const Allocation& allocation, double before, double after)
        : allocation_(allocation), line_{before, after, after - before,
                                         allocation.rays_up_to.back()} {
        assert(std::abs(line_.all - 1) < max_rounding);
    }

    /// Calls found(cell, expected, low, high) for each cell with rays, in their order. `expected`
    /// is N_tr; the cell's rays are those from low + 1 to high.
    template <class Found>
    void for_each_cell(const Found& found) const {
        constexpr std::size_t block = 64;
        std::array<std::int64_t, block + 1> last;
        auto low = static_cast<std::int64_t>(line_.before);
        const std::size_t cells = allocation_.cells.size();
        for (std::size_t first = 0; first < cells; first += block) {
            last[0] = low;
            std::uint64_t with_rays = sampling_kernels().last_rays(
                line_, std::min(block, cells - first), &allocation_.rays_up_to[first], last.data());
            for (; with_rays != 0; with_rays &= with_rays - 1) {
                const auto k = static_cast<std::size_t>(std::countr_zero(with_rays));
                found(allocation_.cells[first + k], line_.rays * allocation_.rays(first + k), low,
                      last[k + 1]);
                low = last[k + 1];
            }
        }
    }

  private:
    /// The most that the sum of the shares of a strategy is off from 1.
    static constexpr double max_rounding = 1e-9;

    Allocation allocation_;
    PatchOnLine line_;
};

} // namespace hemilux
