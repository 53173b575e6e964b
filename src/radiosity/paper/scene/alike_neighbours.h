#pragma once
// Finds patches that are near to a patch and much like it. What is uncertain about one is about as
// uncertain about the others, so errors that are poorly known from one patch are pooled over them.

#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

/// Calls visit(j) for each patch beside `i` that is like it. It is near in the order of the file,
/// of the same material, of about the same area, and faces nearly the same way. `i` itself is not
/// visited.
template <class Visit>
void for_alike_neighbours(const Mesh& mesh, std::uint32_t i, const Visit& visit) {
    constexpr std::uint32_t reach = 6;
    constexpr double max_turned = .9, max_area = 2; ///< cosine of the angle; ratio
    const auto patches = mesh.patches();
    const Patch& at = patches[i];
    const std::uint32_t begin = i > reach ? i - reach : 0;
    const std::uint32_t end =
        std::min<std::uint32_t>(i + reach + 1, static_cast<std::uint32_t>(patches.size()));
    for (std::uint32_t j = begin; j < end; ++j) {
        const Patch& other = patches[j];
        if (j != i && other.material == at.material &&
            glm::dot(other.normal, at.normal) > max_turned &&
            std::max(other.area, at.area) <= max_area * std::min(other.area, at.area))
            visit(j);
    }
}

/// Pools variances [any unit], by patch and channel, that are poorly known from a few samples each.
/// Returns for each patch the larger of two values: the mean over the patch and its neighbours, and
/// the mean of that and the patch's own variance.
[[nodiscard]] std::vector<Vec3> pooled_over_neighbours(const Mesh& mesh,
                                                       std::span<const Vec3> variance);

} // namespace hemilux
