#pragma once
// What all methods that shoot rays at random share: points and directions to shoot from, where a
// ray arrives, and what power in three channels is worth.

#include "bvh/tracer.h"
#include "geometry/compensated_sum.h"
#include "geometry/polygon_sampler.h"
#include "radiosity/rays/receivers.h"
#include "radiosity/sampling/rng.h"
#include "radiosity/sampling/sampling_kernels.h"
#include "radiosity/scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hemilux {

/// What decides how many rays a power in three channels is worth.
[[nodiscard]] inline double mean_of_channels(const Vec3& power) {
    return (power.x + power.y + power.z) / 3;
}

/// By all patches, local units.
[[nodiscard]] inline Vec3 emitted_power(const Mesh& mesh) {
    CompensatedSum<Vec3> power;
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i)
        power += mesh.patches()[i].area * mesh.material(i).emission;
    return power.value();
}

/// Weighted by area; at most .999, so that 1 / (1 - rho) remains a number of use.
[[nodiscard]] inline double mean_reflectance(const Mesh& mesh) {
    double area = 0, sum = 0;
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i) {
        area += mesh.patches()[i].area;
        sum += mesh.patches()[i].area * mean_of_channels(mesh.material(i).reflectance);
    }
    return area > 0 ? std::min(sum / area, .999) : 0;
}

/// A direction with density cos(theta) / pi: a point uniform on the disc, lifted to the hemisphere.
/// Trying points of the square is sooner done than a sine and a cosine.
[[nodiscard]] inline Vec3 sample_cosine(Rng& rng) {
    for (;;) {
        const double x = 2 * rng.uniform() - 1, y = 2 * rng.uniform() - 1;
        const double z_squared = 1 - x * x - y * y;
        if (z_squared > 0)
            return {x, y, std::sqrt(z_squared)};
    }
}

/// A direction with density cos(theta) / pi by the concentric map (sampling_kernels.h).
[[nodiscard]] inline Vec3 cosine_direction(Vec2 u) {
    Vec3 direction;
    sampling_kernels().cosine(1, &u.x, &u.y, &direction.x, &direction.y, &direction.z);
    return direction;
}

/// A point uniform over a polygon.
[[nodiscard]] inline Vec3 sample_uniform(const PolygonSampler& polygon, Rng& rng) {
    const double u = rng.uniform(), v = rng.uniform();
    return polygon.sample({u, v});
}

/// A ray from anywhere on a patch, by Lambert's law. `frame` is one of its hemisphere.
[[nodiscard]] inline Ray cosine_ray(const Patch& from, const PolygonSampler& points,
                                    const Frame& frame, Rng& rng) {
    Ray ray{sample_uniform(points, rng), frame.to_world(sample_cosine(rng))};
    ray.from = from.facet;
    return ray;
}

} // namespace hemilux
