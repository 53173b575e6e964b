#pragma once
// The files that a run reads and writes, and whether it can. This is checked before the scene is
// read.

#include "app/gathering/lightmap_layout.h"
#include "app/settings/outputs.h"
#include "app/settings/settings.h"

#include <string>
#include <vector>

namespace hemilux {

/// Returns the files of the run, as far as they are known before the scene is read. Throws
/// UsageError where nothing would be written or an output is another file of the run. Throws
/// OutputError where a file cannot be made, InputError where one cannot be read.
[[nodiscard]] RunFiles check_files(const SolveSettings& settings);

/// Finds the lightmaps of `bake` (lightmap_of_file()). Those of objects have files whose names
/// are known only now: throws as check_files() does for these.
[[nodiscard]] FileLightmap lightmaps_to_write(const SolveSettings& settings, const Mesh& mesh,
                                              const std::vector<PrimitiveOrigin>& origins,
                                              std::vector<std::string>& warnings);

/// Throws OutputError where the charts of the scene do not fit into the file of --lightmap, however
/// its faces are divided.
void check_lightmap(const SolveSettings& settings, const Mesh& mesh);

} // namespace hemilux
