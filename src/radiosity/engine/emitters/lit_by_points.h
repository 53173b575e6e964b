#pragma once
// Lets every method solve scenes with lights without extent.
//
// Such a light brings D to a patch (light_of_points.h), which reflects rho D of it. The method
// solves for a mesh whose patches emit
//
//     E' = E + rho D
//
// and so finds B, the first reflection included. D is known before the first step from a fixed
// number of shadow rays. Its standard errors join those of the method, and the powers that the
// method cannot know join the balance of energy. A method that traces shadow rays by itself
// (Method::takes_points) is left as it is.

#include "radiosity/engine/solving/method.h"

#include <memory>

namespace hemilux {

/// Makes the solver of a method, or of its page if `plain`, for any scene.
[[nodiscard]] std::unique_ptr<Solver> make_solver(const Method& method, const SolverInput& input,
                                                  bool plain = false);

} // namespace hemilux
