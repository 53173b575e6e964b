#pragma once
// --sides: faces that look away from the light are turned or reported.

#include "app/settings.h"
#include "radiosity/orientation.h"

#include <string>

namespace hemilux {

/// Turns faces where --sides says so, and says on stderr what was turned, what looks away all the
/// same, or what lamps emit that shine to both sides. `threads`: 0 for one per core.
void settle_sides(Scene& scene, const SceneSettings& settings, Talk talk, unsigned threads = 0);

/// Lines of `info`: names on the left, figures on the right. What is as it should be gets no line.
[[nodiscard]] std::string describe(const Orientation& orientation, const Scene& scene, Sides sides);
/// The same of lamps that shine to both sides.
[[nodiscard]] std::string describe_both_sides(const Scene& scene);

} // namespace hemilux
