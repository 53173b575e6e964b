#pragma once
// --sides: what `info` says of it, and the division of a scene of a file.

#include "app/settings/settings.h"
#include "radiosity/answers/run/sides.h"

#include <string>

namespace hemilux {

/// Divides the faces and turns them as --sides says; reports that on stderr. Throws as
/// divide_scene().
[[nodiscard]] SidedMesh divide_with_sides(Scene scene, const SceneSettings& settings,
                                          const SolveOptions& options, Verbosity verbosity);

/// Returns lines of `info`: names on the left, figures on the right. What is as it should be gets
/// no line.
[[nodiscard]] std::string describe(const Orientation& orientation, const Scene& scene, Sides sides);
/// Returns the same for emitters that shine to both sides.
[[nodiscard]] std::string describe_both_sides(const Scene& scene);

} // namespace hemilux
