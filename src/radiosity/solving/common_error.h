#pragma once
// What a patch and its neighbours err by together.
//
// The standard error of a mean of a few batches is known badly. Where patches err each for itself
// it is pooled over neighbours (alike_neighbours.h); where they err together that does not help,
// and the variance is raised as Student's t asks for, so that hardly any error is beyond three
// standard errors.

#include "radiosity/scene/alike_neighbours.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace hemilux {

/// What the variance of patch `i` is to be multiplied with: 1 where patches err each for itself, 3
/// where all err together. `deviations(j)` is what each batch is off from their mean at patch j: an
/// array of one Vec3 for each batch.
template <class Deviations>
[[nodiscard]] double raise_of_common_error(const Mesh& mesh, std::uint32_t i,
                                           const Deviations& deviations) {
    constexpr double of_few = 3; // of t with three degrees of freedom 96 of 100 are below 2 sqrt(3)
    auto sums = deviations(i);
    double squares = 0, count = 1;
    for (const Vec3& off : sums)
        squares += glm::dot(off, off);
    for_alike_neighbours(mesh, i, [&](std::uint32_t j) {
        const auto off = deviations(j);
        for (std::size_t s = 0; s < off.size(); ++s) {
            sums[s] += off[s];
            squares += glm::dot(off[s], off[s]);
        }
        ++count;
    });
    if (count < 2 || !(squares > 0))
        return of_few;
    double of_sum = 0;
    for (const Vec3& sum : sums)
        of_sum += glm::dot(sum, sum);
    const double together = std::clamp((of_sum / squares - 1) / (count - 1), 0.0, 1.0);
    return 1 + (of_few - 1) * together;
}

} // namespace hemilux
