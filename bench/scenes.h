#pragma once
// The scenes of the measurement, made in code: a closed Cornell box and a room full of boxes and
// spheres, of triangles alone, at any fineness.

#include "radiosity/paper/scene/scene.h"

#include <cstdint>
#include <string>

namespace hemilux::bench {

/// About 18 n^2 triangles.
[[nodiscard]] Scene cornell_box(std::uint32_t n);
/// About 54 n^2 triangles.
[[nodiscard]] Scene cluttered_room(std::uint32_t n);

} // namespace hemilux::bench
