#pragma once
// About how much of the emitted power falls on patches: a moment's work before the first ray.

#include "geometry/vector.h"

namespace hemilux {

class Mesh;

/// Were nothing between patches and emitters, local units. A sun sends most of its light elsewhere,
/// and what lights a scene is to be measured by what gets there.
[[nodiscard]] Vec3 power_to_patches(const Mesh& mesh);

} // namespace hemilux
