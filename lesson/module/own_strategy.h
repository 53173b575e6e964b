#pragma once
// A method of the lesson's reader: it says which share of a patch's rays and of its power each
// spherical triangle gets, and the rest is as on the page of section 5.

#include "radiosity/paper/solving/solver.h"

#include <memory>
#include <span>

namespace hemilux::lesson {

/// The rules of the print besides the shares (docs/paper/decisions.md, D2, D4, D10).
struct OwnRules {
    bool from_centre = false; ///< rays start at the centre of their patch
    /// Each patch with power shoots N_hemi rays, and N_tr is rounded to the nearest whole number,
    /// so that power is lost. A ten-thousandth of the light is not shot.
    bool rounded = false;
};

/// Makes the solver. `triangles` has, for each patch, the number of its triangles and then three
/// numbers for each of these: its index among Hemisphere::cells(), its share of the rays and its
/// share of the power [-]. Power of a triangle without rays is lost, which the balance of energy
/// shows. Throws std::invalid_argument where the numbers are not that, or shares are negative.
[[nodiscard]] std::unique_ptr<Solver>
own_strategy(const SolverInput& input, std::span<const double> triangles, const OwnRules& rules);

} // namespace hemilux::lesson
