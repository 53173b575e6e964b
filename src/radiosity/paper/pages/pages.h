#pragma once
// Methods on one page each: the slow, obviously right versions.
//
// A page is nested loops with the paper's names, one ray at a time. It has no threads and no vector
// instructions, and keeps nothing but what the method is about. To read one, have the scene, the
// mesh, the tracer and the random numbers at hand. Sections 3.2 to 5 also need step.h, where power
// is received and reflected, section 4 stored_subdivision.h and edge_division.h, section 5
// hemisphere.h, and sections 2 and 3.1 batches.h.
//
// The tests compare the engine with the pages of sections 3.2 to 5 by ==, all bits of the
// radiosity. They compare the other two, whose engines find form factors in better ways, within
// standard errors. Pages and engine average their steps by the same code (mean_of_steps.h). The
// option on the command line is --plain.
//
// A page does everything, even what the scene does not need. Only the end of a run where nothing
// reflects follows the needs of the scene.

#include "radiosity/paper/solving/solver.h"

#include <cstddef>
#include <memory>

namespace hemilux {
struct Subdivision1997Options;
}

namespace hemilux::plain {

/// Makes the full matrix, section 2. It keeps all pairs of patches, 40 bytes each. Throws
/// std::invalid_argument if there are more than `max_patches_of_matrix` patches.
[[nodiscard]] std::unique_ptr<Solver> matrix(const SolverInput& input);
inline constexpr std::size_t max_patches_of_matrix = 2000;
/// Makes progressive radiosity, section 3.1. A step is one shot.
[[nodiscard]] std::unique_ptr<Solver> progressive(const SolverInput& input);
/// Makes the same; with `ambient` the image shows a guess of the light that is still unshot.
[[nodiscard]] std::unique_ptr<Solver> progressive(const SolverInput& input, bool ambient);
/// Makes Monte Carlo radiosity, section 3.2.
[[nodiscard]] std::unique_ptr<Solver> monte_carlo(const SolverInput& input);
/// Makes Monte Carlo progressive radiosity, section 3.3.
[[nodiscard]] std::unique_ptr<Solver> progressive_monte_carlo(const SolverInput& input);
/// Makes the technique of 1997, section 4.
[[nodiscard]] std::unique_ptr<Solver> hemisphere_1997(const SolverInput& input);
/// Makes the same with the user's parameters.
[[nodiscard]] std::unique_ptr<Solver> hemisphere_1997(const SolverInput& input,
                                                      const Subdivision1997Options& numbers);
/// Makes the new approach of hemisphere subdivision, section 5.
[[nodiscard]] std::unique_ptr<Solver> hemisphere(const SolverInput& input);

/// Answers whether an image is useful: "Useful (Image)" of the paper.
using Useful = bool (*)(const Solution& image);
/// The paper's procedure NewHemisphereRadiosity (Scene), section 5, from its beginning to its end.
/// The program does the same step by step, and asks whether the image is useful by its stop rules.
[[nodiscard]] Solution new_hemisphere_radiosity(const SolverInput& scene, Useful useful);

} // namespace hemilux::plain
