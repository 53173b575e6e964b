#pragma once
// A camera that shows something of any scene: into an open box through its opening, a closed room
// from within, an object from outside.

#include "io/pictures/camera.h"

namespace hemilux {

/// The axis that is upwards, 1 for y or 2 for z, by what is usual: lamps shine down, floors and
/// ceilings are wider than walls, rooms wider than high. y unless most of that speaks for z.
[[nodiscard]] int guess_up(const Mesh& mesh);

/// Tries many places and directions with a few rays each, and chooses the one that shows the most
/// lit surface, of the most kinds. `radiosity` is per patch, `aspect` width over height. The same
/// arguments give the same camera. `up`: the axis that is upwards; empty: guess_up().
[[nodiscard]] Camera automatic_camera(const Mesh& mesh, const Tracer& tracer,
                                      std::span<const Vec3> radiosity, double aspect = 4.0 / 3.0,
                                      std::optional<int> up = {}, unsigned threads = 0);

} // namespace hemilux
