#pragma once
// How wrong is the picture? The page of learned light (light_cache.h): gathers, walks, cells and
// the error, one ray at a time and nothing else. It finds emitters by random rays.

#include "bvh/tracer.h"
#include "radiosity/engine/rays/surface_point.h"
#include "radiosity/light/cached_light/patch_light.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;

struct PlainAnswer {
    std::vector<Vec3> irradiance; ///< by point, from the light as it was learned [W/m2]
    /// By round, the squared error of gathers at the points that read what was known before it, as
    /// a mean over points and channels [(W/m2)^2]. It is free of noise on average, so it may be
    /// negative.
    std::vector<double> squared_error;
};

/// Finds the light at points from what patches send: so many rounds of two groups of `walks` walks
/// from each point, then a gather of so many rays at each.
[[nodiscard]] PlainAnswer how_wrong(const Mesh& mesh, const Tracer& tracer, const PatchLight& light,
                                    std::span<const SurfacePoint> points, std::size_t rounds,
                                    std::size_t walks, std::size_t rays, std::uint64_t seed);

} // namespace hemilux
