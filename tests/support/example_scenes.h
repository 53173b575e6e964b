#pragma once
// The committed scenes of examples/scenes, read without the shell: by the few words of OBJ that
// their generator writes.

#include "radiosity/paper/scene/scene.h"

#include <string>

namespace hemilux::test {

/// Returns the scene of examples/scenes/NAME.obj. Throws std::runtime_error where there is none.
[[nodiscard]] Scene example_scene(const std::string& name);

} // namespace hemilux::test
