#pragma once
// A ray of doubles as the wide tree's kernels see it, in the tree's units.

#include "bvh/tracer.h"
#include "bvh/wide/wide_layout.h"
#include "geometry/box.h"

#include <algorithm>
#include <cmath>

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

/// This bounds the error of a scaled distance, apart from the distance's own rounding.
inline constexpr double distance_slack = 0x1p-30;

/// The kernels' t is (t - skipped) * per_unit.
struct Scaling {
    double skipped = 0, per_unit = 1;

    /// Returns certain bounds of a distance in scaled units, which belongs to `slot`.
    [[nodiscard]] Nearest bounds(double t, std::uint32_t slot, std::uint32_t front) const {
        const double at = std::min((t - skipped) * per_unit, double{farthest});
        const double error = std::abs(at) * 0x1p-22 + distance_slack;
        return {static_cast<float>(at - error), static_cast<float>(at + error), slot, front};
    }
};

[[nodiscard]] Fit scale_ray(const Ray& ray, const Space& space, FloatRay& scaled, Scaling& scaling);

} // namespace hemilux::wide
