#pragma once
// Scenes on which the error that a method reports is compared with the true one: small or far
// emitters, narrow holes, bright interiors, emissions many powers of ten apart. Each comes with a
// reference that no method of the library made, but for the controls (controls.cpp).

#include "radiosity/paper/scene/mesh.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace hemilux::test {

struct HardScene {
    Scene scene;
    MeshOptions options = {};
    std::vector<Vec3> reference = {};       ///< B of each patch
    std::vector<Vec3> reference_error = {}; ///< one standard error of it, or a bound
    /// Groups of patches whose mean a method should know: each room, the ground.
    std::vector<std::vector<std::uint32_t>> parts = {};
    /// How far the worst row of form factors of the reference was from its known sum before it was
    /// closed; 0 where rows are not known.
    double row_error = 0;
};

/// A scene of a family, made when it is asked for.
struct HardSceneEntry {
    std::string family, name;
    std::function<HardScene()> make;
};

/// All of them, family by family.
[[nodiscard]] const std::vector<HardSceneEntry>& hard_scenes();
/// The scene of an entry; it is made once in a process.
[[nodiscard]] const HardScene& hard_scene(const HardSceneEntry& entry);

} // namespace hemilux::test
