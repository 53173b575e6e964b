#pragma once
// --spill: arrays that memory has no room for lie in a file.
//
// It holds for all of the program: operator new itself takes the memory of large arrays from there,
// so nothing that solves knows of it, and its results are the same bytes.

#include "app/settings/settings.h"

#include <cstdint>

namespace hemilux {

/// Where a folder is given: from now on large arrays take the bytes of --memory at the most, and
/// those that do not fit lie in a file in the folder; so --memory limits nothing else any more.
/// Called once. Throws OutputError where no file can be made there, UsageError without --memory.
void begin_spilling(SceneSettings& scene);

/// The solver is made: from now on vectors of all patches may take all of the memory. Other arrays,
/// and those made before, are in memory up to an eighth of it.
void leave_memory_to_steps();

/// The size of that file; 0 without one.
[[nodiscard]] std::uint64_t bytes_spilled();

} // namespace hemilux
