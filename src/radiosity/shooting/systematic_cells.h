#pragma once
// Which cells the rays of a patch go to: systematic sampling.
//
// All patches and their cells own intervals of one line, one after the other, as long as their
// expected numbers of rays, and a ray stands at each whole number. As the line's origin is random,
// each cell gets its expected number on average, rounded up or down.

#include "radiosity/shooting/strategy.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

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
        constexpr std::size_t block = 8;
        std::array<std::int64_t, block> up_to; // the last ray of each cell
        std::array<std::size_t, block> with_rays;
        auto low = static_cast<std::int64_t>(before_);
        for (std::size_t first = 0; first < allocation_.cells.size(); first += block) {
            const std::size_t size = std::min(block, allocation_.cells.size() - first);
            if (last_ray(first + size - 1) == low) // as most are when the light is nearly spent
                continue;
            for (std::size_t k = 0; k < size; ++k)
                up_to[k] = last_ray(first + k);
            std::size_t count = 0;
            for (std::size_t k = 0; k < size; ++k) { // a branch would be guessed wrong
                with_rays[count] = k;
                count += up_to[k] > (k > 0 ? up_to[k - 1] : low) ? 1 : 0;
            }
            for (const std::size_t k : std::span(with_rays).first(count)) {
                const auto before = static_cast<double>(std::exchange(low, up_to[k]));
                found(allocation_.cells[first + k], rays_ * allocation_.rays(first + k), before,
                      static_cast<double>(up_to[k]));
            }
        }
    }

  private:
    /// The last cell with any share ends where the patch does; those after it own nothing.
    [[nodiscard]] std::int64_t last_ray(std::size_t cell) const {
        return static_cast<std::int64_t>(allocation_.rays_up_to[cell] <
                                                 allocation_.rays_up_to.back()
                                             ? before_ + rays_ * allocation_.rays_up_to[cell]
                                             : after_);
    }

    Allocation allocation_;
    double before_, after_;
    double rays_; ///< for one unit of the running sums
};

} // namespace hemilux
