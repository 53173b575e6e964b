#pragma once
// A scene for subcommands that need no light: nothing has to emit.

#include "app/settings/settings.h"

namespace hemilux {

/// Reads and divides, with warnings and figures as the user wants them. Throws InputError,
/// UsageError.
[[nodiscard]] Mesh load_geometry(const SceneSettings& settings, const RunFiles& files,
                                 Verbosity verbosity);

} // namespace hemilux
