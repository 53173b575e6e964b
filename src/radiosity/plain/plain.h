#pragma once
// Methods on one page each: the slow, obviously right versions.
//
// A page is nested loops with the paper's names, one ray at a time: no threads, no vector
// instructions, nothing kept but what the method is about. To read one, have the scene, the mesh,
// the tracer and the random numbers at hand, and for section 5 the hemisphere. The tests hold the
// engine to these pages with ==, all bits of radiosity and standard errors; `stored-transport`,
// whose page shows the principle alone, within standard errors. On the command line: --plain.
//
// A page does everything, also what the scene does not need: only the end of a run where nothing
// reflects follows the needs of the scene.

#include "radiosity/solving/solver.h"

#include <memory>

namespace hemilux::plain {

/// Monte Carlo radiosity, section 3.2.
[[nodiscard]] std::unique_ptr<Solver> monte_carlo(const SolverInput& input);
/// Monte Carlo progressive radiosity, section 3.3.
[[nodiscard]] std::unique_ptr<Solver> progressive_monte_carlo(const SolverInput& input);
/// The technique of 1997, section 4.
[[nodiscard]] std::unique_ptr<Solver> hemisphere_1997(const SolverInput& input);
/// The new approach of hemisphere subdivision, section 5.
[[nodiscard]] std::unique_ptr<Solver> hemisphere(const SolverInput& input);
/// Not of the paper: all bounces solved on what rays struck. All pairs of patches are kept, 48
/// bytes each; throws std::invalid_argument where there are more patches than that is meant for.
[[nodiscard]] std::unique_ptr<Solver> stored_transport(const SolverInput& input);
inline constexpr std::size_t most_patches_of_stored_transport = 2000;

} // namespace hemilux::plain
