#pragma once
// An estimate of how much of the emitted power falls on patches, without tracing a ray.

#include "geometry/vector.h"

namespace hemilux {

class Mesh;

/// The power that would arrive at patches if nothing stood between them and the emitters, in W/m2
/// times area in local units. A sun sends most of its light elsewhere; the light of a scene is to
/// be measured by the power that arrives.
[[nodiscard]] Vec3 power_to_patches(const Mesh& mesh);

} // namespace hemilux
