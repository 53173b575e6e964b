#pragma once
// A scene for subcommands that need no light: nothing has to emit.

#include "app/loading/load.h"
#include "app/memory/memory.h"

#include <functional>
#include <string>

namespace hemilux {

struct LoadedGeometry {
    Mesh mesh;
    FileView view;
    std::vector<PrimitiveOrigin> origins; ///< ReadResult
    std::vector<std::string> warnings;    ///< those of the file, which were logged
};

/// What a command makes of the patches.
struct GeometryUse {
    std::function<double(double patches)> bytes; ///< of it at its peak
    std::string advice;                          ///< on what needs less memory
};

/// Reads and divides a scene, with warnings and figures as the user wants them. Throws InputError
/// and UsageError, and std::runtime_error where that and its use need more than --memory.
[[nodiscard]] LoadedGeometry load_geometry(const SceneSettings& settings, const RunFiles& files,
                                           const SolveOptions& options, const GeometryUse& use,
                                           Verbosity verbosity);

} // namespace hemilux
