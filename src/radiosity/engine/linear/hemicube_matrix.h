#pragma once
// Implements the method `matrix` with the form factors of hemicubes: one step, and no standard
// error.

#include <memory>

namespace hemilux {

class EngineSolver;
struct SolverInput;

/// Makes a solver of B = E + rho F B with F as the hemicubes show it (hemicube.h), solved once. Its
/// errors are not random, so nothing is estimated of them: standard errors are NaN. As A_i F_ij =
/// A_j F_ji does not hold, some light is made or lost between patches; EnergyBalance::unshot is
/// what that comes to. Throws SolveError where the hemicubes show no way for the light to end.
[[nodiscard]] std::unique_ptr<EngineSolver> make_hemicube_matrix(const SolverInput& input);

} // namespace hemilux
