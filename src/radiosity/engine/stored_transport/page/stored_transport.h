#pragma once
// Stored transport on one page, as the pages of the paper's methods (radiosity/paper/pages).

#include "radiosity/paper/solving/solver.h"

#include <cstddef>
#include <memory>

namespace hemilux::plain {

/// Makes stored transport, which is not in the paper: all bounces are solved on what rays hit. It
/// keeps all pairs of patches, 48 bytes each. Throws std::invalid_argument if there are more than
/// `max_patches_of_stored_transport` patches.
[[nodiscard]] std::unique_ptr<Solver> stored_transport(const SolverInput& input);
inline constexpr std::size_t max_patches_of_stored_transport = 2000;

} // namespace hemilux::plain
