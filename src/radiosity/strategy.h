#pragma once
// A strategy deals a patch's rays and power to the cells of its hemisphere. That is all in which
// the stepwise shooting methods differ: the loops of Compute Radiosity (paper section 5b) are the
// same.

#include "radiosity/solver.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace hemilux {

/// What one cell gets, as shares of the patch's whole: power [-] and expected rays [-], each
/// summing to 1 over the cells of a patch. With power = projected solid angle / pi every strategy
/// is unbiased, however the rays are dealt, as long as each cell with power has a positive share of
/// them.
struct CellShare {
    std::uint16_t cell; ///< of Hemisphere::cells(), or whole_hemisphere
    double power;       ///< A_tr / A_hemi in the paper
    double rays;        ///< N_tr / N_hemi in the paper
};

inline constexpr std::uint16_t whole_hemisphere = 0xffff;

class Strategy {
  public:
    virtual ~Strategy() = default;
    /// The cells of a patch, always in the same order. Callable from several threads.
    virtual void deal(std::uint32_t patch, std::vector<CellShare>& shares) const = 0;

    [[nodiscard]] virtual std::uint64_t density_rays() const { return 0; }
    [[nodiscard]] virtual std::uint64_t density_bytes() const { return 0; }
};

} // namespace hemilux
