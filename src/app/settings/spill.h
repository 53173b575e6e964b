#pragma once
// --spill: arrays that memory has no room for lie in a file.
//
// This holds for all of the program: operator new itself takes the memory of large arrays from
// there. So nothing that solves knows of it, and its results are the same bytes.

#include "app/settings/settings.h"

#include <cstdint>

namespace hemilux {

/// Begins spilling where a folder is given. From then on large arrays take the bytes of --memory at
/// the most, and those that do not fit lie in a file in the folder. So --memory then limits nothing
/// else. It is called once. Throws OutputError where no file can be made there, UsageError without
/// --memory.
void begin_spilling(SceneSettings& scene);

/// Gives memory to the steps, once the solver is made: vectors of all patches may then take all of
/// it. Other arrays, and those made before, are in memory up to an eighth of it.
void leave_memory_to_steps();

/// Returns the size of that file; 0 without one.
[[nodiscard]] std::uint64_t bytes_spilled();

} // namespace hemilux
