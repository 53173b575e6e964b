#pragma once
// The share of surfaces that suns shine on.

#include "radiosity/answers/surfaces/surface_factors.h"

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace hemilux {

/// Finds the sunlit fractions of all surfaces, and then of points, for each sun by error, seed and
/// threads that are asked for, and calls keep(sun, shares) with them. `suns` are unit vectors to
/// them. An interrupt ends it after the suns that are complete.
void find_sunlit(const FactorsAsked& asked, const FactorScene& scene, std::span<const Vec3> suns,
                 std::span<const FactorPoint> points, Monitor& monitor,
                 const std::function<void(std::size_t sun, std::vector<OpenShare> shares)>& keep);

} // namespace hemilux
