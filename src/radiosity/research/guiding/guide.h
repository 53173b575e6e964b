#pragma once
// The option --guide says what guides the method `hemisphere`.

#include "radiosity/paper/solving/solve_options.h"

namespace hemilux {

enum class Guide {
    density, ///< surfaces along a ray, as in the paper
    pyramid, ///< patches in the pyramid of a triangle of directions
    visible, ///< what is visible: rho^2 / A of the nearest patch
    learned  ///< the same, from the hits of the steps before
};

/// Returns the guide of the options; with `literal` it is the density.
[[nodiscard]] inline Guide guide_of(const SolveOptions& options) {
    return options.literal ? Guide::density : options.own.of<Guide>();
}

} // namespace hemilux
