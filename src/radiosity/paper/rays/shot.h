#pragma once
// Holds what all methods that shoot random rays share: where rays go, and how many rays a power in
// three channels gets. Where they start is in patch_start.h.

#include "bvh/tracer.h"
#include "geometry/compensated_sum.h"
#include "geometry/polygon_sampler.h"
#include "radiosity/paper/sampling/concentric_map.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hemilux {

/// Returns the mean of a power in three channels. Rays are allocated in proportion to it.
[[nodiscard]] inline double mean_of_channels(const Vec3& power) {
    return (power.x + power.y + power.z) / 3;
}

/// Returns the power that all patches emit [W/m2 times area in local units].
[[nodiscard]] inline Vec3 emitted_power(const Mesh& mesh) {
    CompensatedSum<Vec3> power;
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i)
        power += mesh.patches()[i].area * mesh.material(i).emission;
    return power.value();
}

/// Returns the mean reflectance of the patches, weighted by area [-]. It is at most 0.999, so that
/// 1 / (1 - rho) remains useful.
[[nodiscard]] inline double mean_reflectance(const Mesh& mesh) {
    double area = 0, sum = 0;
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i) {
        area += mesh.patches()[i].area;
        sum += mesh.patches()[i].area * mean_of_channels(mesh.material(i).reflectance);
    }
    return area > 0 ? std::min(sum / area, .999) : 0;
}

/// Draws a direction with density cos(theta) / pi: a point uniform on the disc, lifted to the
/// hemisphere. Rejecting points of the square is faster than a sine and a cosine.
[[nodiscard]] inline Vec3 sample_cosine(Rng& rng) {
    for (;;) {
        const double x = 2 * rng.uniform() - 1, y = 2 * rng.uniform() - 1;
        const double z_squared = 1 - x * x - y * y;
        if (z_squared > 0)
            return {x, y, std::sqrt(z_squared)};
    }
}

/// Maps u to a direction with density cos(theta) / pi (concentric_map.h).
[[nodiscard]] inline Vec3 cosine_direction(Vec2 u) {
    Vec3 direction;
    concentric_direction(u.x, u.y, direction.x, direction.y, direction.z);
    return direction;
}

} // namespace hemilux
