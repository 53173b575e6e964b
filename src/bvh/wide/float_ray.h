#pragma once
// A ray of doubles as the wide tree's kernels see it, in the tree's units.

#include "bvh/tracer.h"
#include "bvh/wide/wide_layout.h"
#include "geometry/box.h"

#include <cmath>
#include <limits>

namespace hemilux::wide {

/// The box of the scene, in the soup's units, and the number by which its coordinates are divided.
struct Space {
    Box bounds;
    double size = 1;
    double shrink = 1; ///< 1 / size, which is exact
};

/// This says whether the kernels can trace the ray.
enum class Fit {
    good,
    misses, ///< certainly, or it is no ray at all
    too_far ///< origin so far away that even doubles round coarsely: every facet is tried
};

[[nodiscard]] Fit scale_ray(const Ray& ray, const Space& space, FloatRay& scaled);

/// This bounds the error of a scaled distance, apart from the distance's own rounding.
inline constexpr double distance_slack = 0x1p-30;

/// Return certain lower and upper bounds of a distance in scaled units, which may be infinite.
[[nodiscard]] inline float below(const FloatRay& scaled, double t) {
    const double at = (t - scaled.skipped) * scaled.per_unit;
    return static_cast<float>(std::isinf(at) ? at : at - std::abs(at) * 0x1p-22 - distance_slack);
}
[[nodiscard]] inline float above(const FloatRay& scaled, double t) {
    const double at = (t - scaled.skipped) * scaled.per_unit;
    return static_cast<float>(at + std::abs(at) * 0x1p-22 + distance_slack);
}

/// Returns the nearest hit of a ray that has met nothing yet.
[[nodiscard]] inline Nearest nothing_before(const FloatRay& scaled, double t_max) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    if (t_max == infinity) // so are its bounds, which take longer to find
        return {infinity, infinity, no_facet, 0};
    return {below(scaled, t_max), above(scaled, t_max), no_facet, 0};
}

} // namespace hemilux::wide
