#pragma once
// Scenes for cameras: what is lit in them lies where a picture easily misses it.

#include "radiosity/paper/scene/scene.h"

namespace hemilux::test {

/// Three walls and a luminous roof that shines to both sides, on a wide ground. The open side is
/// along +x, -x, +z or -z for 0, 1, 2, 3.
[[nodiscard]] Scene pavilion(int open_side, double emission = 0.4);

/// A dark room of 8 x 3 x 8 m with a closed case of 0.5 m on its floor, in which a lamp shines. Its
/// groups are "room", "case" and "lamp".
[[nodiscard]] Scene lamp_in_case();

/// A board on a foot whose narrow end is below, beginning at a height of 0.
[[nodiscard]] Scene standing_thing();

/// Returns the scene with z upwards: x stays, y becomes z, z becomes -y.
[[nodiscard]] Scene turned_to_z(Scene scene);
[[nodiscard]] inline Vec3 turned_to_z(const Vec3& v) { return {v.x, -v.z, v.y}; }

} // namespace hemilux::test
