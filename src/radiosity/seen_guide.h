#pragma once
// The hemisphere guided by what is seen instead of how many surfaces are pierced.
//
// A ray that strikes patch j adds rho_j^2 Phi^2 / A_j to the area-weighted variance of the
// solution. So a triangle is worth rays in proportion to its power and to the root of the mean of
// rho^2 / A over what is seen through it: small and bright things want rays, what stands behind
// walls does not. Each vertex keeps this number for the nearest patch in one byte, as a logarithm.
// As only the nearest patch counts, three empty corners say little of what is between them: no
// triangle gets less than a part of its share by power, so that nothing starves. With `learn` the
// means come from the hits of the steps before as they arrive.

#include "radiosity/strategy.h"

#include <memory>

namespace hemilux {

class Workers;

[[nodiscard]] std::unique_ptr<Strategy> make_seen_guide(const SolverInput& input,
                                                        const Hemisphere& hemisphere,
                                                        const Workers& workers, bool learn);

} // namespace hemilux
