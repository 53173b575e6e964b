#pragma once
// Which cells the rays of a patch go to: systematic sampling.
//
// All patches and their cells own intervals of one line, one after the other, as long as their
// expected numbers of rays, and a ray stands at each whole number. As the line's origin is random,
// each cell gets its expected number on average, rounded up or down.

#include "radiosity/shooting/strategy.h"

#include <cstddef>
#include <cstdint>

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
        double low = whole_below(before_);
        for (std::size_t k = 0; k < allocation_.cells.size(); ++k) {
            const double end = end_of(k);
            if (end < low + 1)
                continue;
            const double high = whole_below(end);
            found(allocation_.cells[k], rays_ * allocation_.rays(k), low, high);
            low = high;
        }
    }

  private:
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
