#pragma once
// The variation of the light within patches: by a linear function, and how much besides.
//
// The light is gathered at points of a patch, twice (final_gather.h). The variance that a linear
// function leaves is the mean product of the differences of the two gathers from their functions.
// All points of a patch share their random numbers. So the noise of a gather is about the same
// everywhere on it and hides little: a few rays are enough.

#include "bvh/tracer.h"
#include "geometry/vector.h"
#include "radiosity/paper/solution/solution.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;
class StopFlag;
class Workers;

/// This is what the light is gathered from.
struct LightSource {
    const Mesh& mesh;
    const Tracer& tracer;
    const Solution& solution;
};

struct WithinOptions {
    /// The number of rounds of rays in each of the two estimates at a point. With more, slopes are
    /// less noisy.
    unsigned rounds = 1;
    /// The number of cosine-distributed rays of a round; shadow rays are half as many. With more,
    /// squares are less noisy too.
    unsigned rays = 8;
    /// Limits the rows of points on large patches; at least 3.
    unsigned max_rows = 8;
    std::uint64_t seed = 1;
};

struct LightWithinPatches {
    /// For each patch that was asked for, area times the variance of the reflected light that a
    /// linear function leaves, summed over channels [local area * (W/m2)^2]. It is an estimate from
    /// few points, which may be negative.
    std::vector<double> square;
    /// Two independent estimates of the slope of each patch.
    std::vector<std::array<Slope, 2>> slopes;
    std::uint64_t rays = 0;
};

/// Measures some patches. If it was interrupted, the rest is 0.
[[nodiscard]] LightWithinPatches light_within_patches(const LightSource& light,
                                                      std::span<const std::uint32_t> patches,
                                                      const WithinOptions& options,
                                                      const Workers& workers,
                                                      const StopFlag& interrupted);

} // namespace hemilux
