#pragma once
// A camera that shows something of any scene: into an open box through its opening, a closed room
// from within, an object from outside.

#include "io/pictures/camera.h"

namespace hemilux {

/// Many places and directions are tried with a few rays each; most lit surface wins, and of many
/// kinds. `radiosity` per patch; `aspect`: width over height. Deterministic.
[[nodiscard]] Camera automatic_camera(const Mesh& mesh, const Tracer& tracer,
                                      std::span<const Vec3> radiosity, double aspect = 4.0 / 3.0);

} // namespace hemilux
