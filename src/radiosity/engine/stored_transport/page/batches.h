#pragma once
// Independent batches of rays give the errors of a solution, and tell where its power goes.

#include "radiosity/paper/solution/solution.h"

#include <span>
#include <vector>

namespace hemilux::plain {

inline constexpr std::size_t batches = 4;

/// Fills in `solution`. B[s] is the radiosity by batch s, by patch; the last of B, that by all rays
/// together, becomes the radiosity of `solution`. Its standard error, its variance and the degrees
/// of freedom follow from how the batches spread. Of `rays` rays of each patch, `escaped[i]` of
/// patch i left the scene; the light that does not escape is absorbed.
void combine_batches(const Mesh& mesh, std::span<const std::vector<Vec3>, batches + 1> B,
                     std::span<const double> escaped, double rays, Solution& solution);

} // namespace hemilux::plain
