#pragma once
// The light of a solution as patches send it: a mean, and where it is known a slope.

#include "radiosity/paper/solution/solution.h"

#include <cstdint>
#include <span>

namespace hemilux {

class Mesh;

/// A view of what patches send: by patch a mean [W/m2], and a slope, or no slopes at all.
struct PatchLight {
    std::span<const Vec3> radiosity;
    std::span<const Slope> slope;

    PatchLight(std::span<const Vec3> of, std::span<const Slope> slopes = {})
        : radiosity(of), slope(slopes) {}
    PatchLight(const Solution& solution) : PatchLight(solution.radiosity, solution.slope) {}
};

/// Returns B at a point of a patch [W/m2]; with a slope, what it reflects is not below 0.
[[nodiscard]] Vec3 radiosity_at(const Mesh& mesh, const PatchLight& light, std::uint32_t patch,
                                const Vec3& point);

} // namespace hemilux
