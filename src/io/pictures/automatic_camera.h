#pragma once
// This chooses a camera for any scene. It looks into an open box through its opening, at a closed
// room from within, and at an object from outside.

#include "io/pictures/camera.h"

namespace hemilux {

/// Guesses the axis that points up, 1 for y or 2 for z, by what is usual. Emitters shine down,
/// floors and ceilings are larger than walls, and rooms are wider than high. The answer is y unless
/// most of that speaks for z.
[[nodiscard]] int guess_up(const Mesh& mesh);

/// Tries many places and directions with a few rays each, and chooses the one that shows the most
/// lit surface, of the most kinds. `radiosity` [W/m2] has one value per patch, and `aspect` is
/// width over height. The same arguments give the same camera. `up` is the axis that points up;
/// where it is empty, guess_up() chooses it.
[[nodiscard]] Camera automatic_camera(const Mesh& mesh, const Tracer& tracer,
                                      std::span<const Vec3> radiosity, double aspect = 4.0 / 3.0,
                                      std::optional<int> up = {}, unsigned threads = 0);

} // namespace hemilux
