#pragma once
// The light at points that are named.

#include "radiosity/answers/gathering/gatherer.h"
#include "radiosity/light/final_gather/light_at_points.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace hemilux {

/// A point at which the light is wanted.
struct WantedPoint {
    Vec3 position; ///< world units [m]
    Vec3 normal;   ///< unit
};

/// The light at points. Where the user or a limit ended the work, points that were not gathered
/// have the light of the patches that they lie on, with an error as it was found at the others.
struct GatheredPoints {
    std::vector<Sensor> sensors; ///< by point
    LightAtPoints found;         ///< lights by point
    TargetLevel level;
};

/// Returns the light at points. An `asked.rays` of the gatherer stands for 256 times as many at
/// each of them: points are fewer than pixels. Without a limit of rays or time they take at most so
/// many rays as some minutes have, or some times those of the solution. `error_of_patches` is that
/// of the solution, if it is known [-]. What is left where a limit ended it is told.
[[nodiscard]] Answer<GatheredPoints> gather_points(Gatherer& gatherer,
                                                   std::span<const WantedPoint> points,
                                                   double error_of_patches = AnswerError::unknown,
                                                   const std::optional<WholeLight>& whole = {});

/// The rays from a point for each ray at a place of a picture, where their number is asked for.
inline constexpr unsigned rays_of_point_per_gather_ray = 256;

} // namespace hemilux
