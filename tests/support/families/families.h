#pragma once
// The families of hard scenes, one file each; hard_scenes() joins them.

#include "support/families/hard_scene.h"

namespace hemilux::test {

using Entries = std::vector<HardSceneEntry>;

[[nodiscard]] Entries lamps_over_ground(); ///< lamp
[[nodiscard]] Entries suns();              ///< sun
[[nodiscard]] Entries pinholes();          ///< pinhole, shade
[[nodiscard]] Entries windows();           ///< window
[[nodiscard]] Entries spheres();           ///< sphere
[[nodiscard]] Entries sealed_rooms();      ///< sealed
[[nodiscard]] Entries channels();          ///< channel
[[nodiscard]] Entries tiny_emitters();     ///< tiny
[[nodiscard]] Entries corridors();         ///< corridor
[[nodiscard]] Entries controls();          ///< control

} // namespace hemilux::test
