#pragma once
// Methods on one page each: the slow, obviously right versions.
//
// A page is nested loops with the paper's names, one ray at a time. It has no threads and no vector
// instructions, and keeps nothing but what the method is about. To read one, have the scene, the
// mesh, the tracer and the random numbers at hand, and step.h, where power is received and
// reflected. Section 5 also needs hemisphere.h, section 4 stored_subdivision.h and edge_division.h,
// and stored transport batches.h. The tests compare the engine with these pages by ==, all bits of
// the radiosity. They compare `stored-transport`, whose page shows the principle alone, within
// standard errors. Page and engine average their steps by the same code (mean_of_steps.h). The
// option on the command line is --plain.
//
// A page does everything, even what the scene does not need. Only the end of a run where nothing
// reflects follows the needs of the scene.

#include "radiosity/paper/solving/solver.h"

#include <memory>

namespace hemilux::plain {

/// Makes Monte Carlo radiosity, section 3.2.
[[nodiscard]] std::unique_ptr<Solver> monte_carlo(const SolverInput& input);
/// Makes Monte Carlo progressive radiosity, section 3.3.
[[nodiscard]] std::unique_ptr<Solver> progressive_monte_carlo(const SolverInput& input);
/// Makes the technique of 1997, section 4.
[[nodiscard]] std::unique_ptr<Solver> hemisphere_1997(const SolverInput& input);
/// Makes the new approach of hemisphere subdivision, section 5.
[[nodiscard]] std::unique_ptr<Solver> hemisphere(const SolverInput& input);
/// Makes stored transport, which is not in the paper: all bounces are solved on what rays hit. It
/// keeps all pairs of patches, 48 bytes each. Throws std::invalid_argument if there are more than
/// `most_patches_of_stored_transport` patches.
[[nodiscard]] std::unique_ptr<Solver> stored_transport(const SolverInput& input);
inline constexpr std::size_t most_patches_of_stored_transport = 2000;

} // namespace hemilux::plain
