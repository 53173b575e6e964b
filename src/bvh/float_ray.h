#pragma once
// A ray of doubles as the wide tree's kernels see it, in the tree's units.

#include "bvh/tracer.h"
#include "bvh/wide_layout.h"

namespace hemilux::wide {

/// The box of the scene and the number its coordinates are divided by.
struct Space {
    Vec3 low, high;
    double size;
};

/// Why a ray needs no kernel, or cannot use one.
enum class Fit {
    good,
    misses, ///< surely, or it is no ray at all
    too_far ///< from so far away that even doubles round coarsely: every facet is tried
};

struct ScaledRay {
    FloatRay ray;
    double skipped = 0; ///< t of the ray at which the scaled one starts
    double unit = 1;    ///< t for a scaled t of one
    Fit fit = Fit::good;

    ScaledRay(const Ray& ray, const Space& space);
    /// Sure bounds of a distance in scaled units.
    [[nodiscard]] float below(double t) const;
    [[nodiscard]] float above(double t) const;
};

} // namespace hemilux::wide
