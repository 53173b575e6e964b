#pragma once
// The powers of lamps that bring the light which is wished at some places.
//
// The light at place p is the sum over lamps k of f_k E_pk, where f_k >= 0 is how many times as
// bright the lamp is as it was solved for. The factors that minimise the sum of the squared
// differences from the wishes W_p are a problem of non-negative least squares, solved by active
// sets (Lawson and Hanson 1974, chapter 23).

#include <cstddef>
#include <vector>

namespace hemilux {

/// A place: what each lamp brings there, the error of that (one sigma), and what is wished, all in
/// one unit.
struct WishedPlace {
    std::vector<double> brought, error;
    double wish = 0;
};

struct LampPowers {
    std::vector<double> factor; ///< by lamp [-]
    /// One sigma of each, by the errors of what lamps bring, as if these were independent; 0 for a
    /// lamp that stays dark.
    std::vector<double> error;
};

/// All places name as many lamps. A lamp that brings no light anywhere stays dark, and of lamps
/// that bring the same everywhere one shines.
[[nodiscard]] LampPowers find_lamp_powers(const std::vector<WishedPlace>& places,
                                          std::size_t lamps);

} // namespace hemilux
