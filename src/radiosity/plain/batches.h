#pragma once
// Errors from independent batches: solutions of the same size, none of which knows of another's
// rays.

#include "radiosity/solving/solution.h"

#include <span>
#include <vector>

namespace hemilux::plain {

inline constexpr std::size_t batches = 4;

/// Sets the standard error, the variance and its degrees of freedom of `solution`, which is the
/// mean of all rays, by how the radiosities of the batches spread: B[s][i] is that of patch i by
/// batch s.
void note_spread_of_batches(const Mesh& mesh, std::span<const std::vector<Vec3>, batches> B,
                            Solution& solution);

} // namespace hemilux::plain
