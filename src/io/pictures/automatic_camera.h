#pragma once
// A camera that shows something of any scene: into an open box through its opening, into a closed
// room from a corner of it or through the backs of its walls, onto an object from outside.

#include "io/pictures/camera.h"

namespace hemilux {

/// Many places and directions are tried with a few rays each; the best picture wins. `radiosity`
/// per patch; `aspect`: width over height. Deterministic.
[[nodiscard]] Camera automatic_camera(const Mesh& mesh, const Tracer& tracer,
                                      std::span<const Vec3> radiosity, double aspect = 4.0 / 3.0);

} // namespace hemilux
