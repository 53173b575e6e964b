#pragma once
// The example scenes, one function each. What each is for stands in README.md beside this file.

#include "scene_writer.h"

namespace hemilux {

[[nodiscard]] SceneWriter make_cornell_box();
[[nodiscard]] SceneWriter make_room();
[[nodiscard]] SceneWriter make_office();
[[nodiscard]] SceneWriter make_building();
[[nodiscard]] SceneWriter make_wall_before_crowd();
[[nodiscard]] SceneWriter make_open_scene();
[[nodiscard]] SceneWriter make_furnace_box();
[[nodiscard]] SceneWriter make_furnace_lshape();
[[nodiscard]] SceneWriter make_cube();
[[nodiscard]] SceneWriter make_cube_of_six();

} // namespace hemilux
