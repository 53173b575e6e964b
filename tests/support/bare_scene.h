#pragma once
// A scene of one material and one group, to which a test adds its faces.

#include "radiosity/paper/scene/scene.h"

namespace hemilux::test {

inline Scene bare_scene() {
    Scene scene;
    scene.materials.emplace_back();
    scene.groups.emplace_back("all");
    return scene;
}

} // namespace hemilux::test
