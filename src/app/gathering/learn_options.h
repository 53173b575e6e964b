#pragma once
// How far light is learned: to the error that was asked for, by the rays that are left.

#include "app/settings/settings.h"
#include "io/results/statistics.h"
#include "radiosity/light/cached_light/light_cache.h"

#include <cstdint>

namespace hemilux {

struct Solution;

/// Returns the rays of the solution and of all that the statistics count.
[[nodiscard]] std::uint64_t rays_spent(const Solution& solution, const Statistics& statistics);

/// Returns the options to learn light to this error [-], by the rays that --max-rays leaves after
/// those of the solution and all that the statistics count.
[[nodiscard]] LearnOptions learn_options(const SolveSettings& settings, double error,
                                         std::uint64_t seed, const Solution& solution,
                                         const Statistics& statistics);

} // namespace hemilux
