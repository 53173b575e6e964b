#pragma once
// A scene for subcommands that need no light: nothing has to emit.

#include "app/settings/settings.h"

namespace hemilux {

/// Reads and divides a scene, with warnings and figures as the user wants them. Throws InputError
/// and UsageError.
[[nodiscard]] Mesh load_geometry(const SceneSettings& settings, const RunFiles& files,
                                 Verbosity verbosity);

} // namespace hemilux
