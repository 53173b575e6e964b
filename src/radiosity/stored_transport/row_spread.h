#pragma once
// How uneven the light is that reaches a patch from all sides: what the variance of its rays, and
// the light that a single ray stands for, follow from. Reported errors need it; allocating rays by
// it (RayPlan::weigh) saves a third of them on open_scene, 4 to 7 % in rooms.

#include "geometry/vector.h"

#include <span>
#include <vector>

namespace hemilux {

class ExchangeMatrix;
class Workers;

/// Each has an entry for each patch.
struct RowSpread {
    std::vector<Vec3> variance; ///< of the light over the directions [(W/m2)^2]
    /// Light of the direction that most of it comes from: mean, weighted by itself [W/m2].
    std::vector<Vec3> typical;
};

/// `light`: what leaves each patch for rays at random to find [W/m2].
[[nodiscard]] RowSpread spread_of_rows(const ExchangeMatrix& factors, std::span<const Vec3> light,
                                       const Workers& workers);

} // namespace hemilux
