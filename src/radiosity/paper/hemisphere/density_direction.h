#pragma once
// Defines where the rays that count surfaces go (paper section 5a, point 1).

#include "geometry/vector.h"

namespace hemilux {

/// Returns the direction of a density ray through a vertex of the table. Vertices on the horizon
/// lie in the patch's plane, where a count would depend on rounding errors; their rays are lifted a
/// little. The ray of the pole is tilted by as much: where walls stand at right angles, there is
/// often an edge straight ahead of the middle of a patch (docs/paper/decisions.md, D7).
[[nodiscard]] Vec3 density_direction(const Vec3& vertex);

} // namespace hemilux
