#pragma once
// Measures how uneven the light is that reaches a patch from all sides. The variance of its rays,
// and the light that a single ray stands for, follow from this. Reported errors need it. Allocating
// rays by it (RayPlan::weigh) saves a third of them on open_scene, 4 to 7 % in rooms.

#include "geometry/vector.h"

#include <span>
#include <vector>

namespace hemilux {

class ExchangeMatrix;
class Workers;

/// The spread of the light, with an entry for each patch.
struct RowSpread {
    std::vector<Vec3> variance; ///< variance of the light over the directions [(W/m2)^2]
    /// The light of the direction that most of it comes from: the mean, weighted by itself [W/m2].
    std::vector<Vec3> typical;
};

/// Computes the spread; `light` is what leaves each patch for random rays to find [W/m2].
[[nodiscard]] RowSpread spread_of_rows(const ExchangeMatrix& factors, std::span<const Vec3> light,
                                       const Workers& workers);

} // namespace hemilux
