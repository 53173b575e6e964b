#pragma once
// Independent batches of rays give the errors of a solution (sections 2 and 3.1).

#include "radiosity/paper/solution/solution.h"

#include <cstddef>
#include <span>
#include <vector>

namespace hemilux::plain {

inline constexpr std::size_t batches = 4;

/// Returns the mean over the batches of what each has found for patch i.
[[nodiscard]] inline Vec3 mean_of_batches(std::span<const std::vector<Vec3>> by_batch,
                                          std::size_t i) {
    Vec3 sum = by_batch[0][i];
    for (std::size_t s = 1; s < batches; ++s)
        sum += by_batch[s][i];
    return sum / double(batches);
}

/// Sets the radiosity of `solution` and its errors. B[s] is the radiosity by batch s, by patch; the
/// last of B, that by all rays together, becomes the radiosity of `solution`. Its standard error,
/// its variance and the degrees of freedom follow from how the batches spread.
void combine_batches(const Mesh& mesh, std::span<const std::vector<Vec3>, batches + 1> B,
                     Solution& solution);

/// Adds to the errors of `solution` what is missing of its light where this much of the light that
/// arrives at each patch is not known [W/m2].
void add_missing(const Mesh& mesh, const Vec3& arriving, Solution& solution);

} // namespace hemilux::plain
