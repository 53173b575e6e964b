#pragma once
// Scenes whose faces all face the right way: rooms and open grounds with lamps, furniture, sheets,
// shades and walls as people model them. Some of their surfaces are lit from behind on purpose.

#include "radiosity/paper/scene/scene.h"

#include <string>
#include <vector>

namespace hemilux::test {

struct SidedScene {
    std::string name;
    Scene scene;
};

[[nodiscard]] std::vector<SidedScene> sided_scenes();

} // namespace hemilux::test
