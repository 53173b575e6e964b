#pragma once
// A scene for subcommands that need no light: nothing has to emit.

#include "app/loading/load.h"

namespace hemilux {

struct LoadedGeometry {
    Mesh mesh;
    FileView view;
};
/// Reads and divides a scene, with warnings and figures as the user wants them. Throws InputError
/// and UsageError.
[[nodiscard]] LoadedGeometry load_geometry(const SceneSettings& settings, const RunFiles& files,
                                           const SolveOptions& options, Verbosity verbosity);

} // namespace hemilux
