#pragma once
// What the module for MPI gives the program, which loads it where mpirun or srun has started it. A
// program that runs alone needs no MPI and does not wait for it to be loaded.

#include "parallel/ranks.h"

namespace hemilux {

/// Starts MPI; the ranks live until it is ended. nullptr where that fails.
using StartRanks = const Ranks* (*)();
/// Ends MPI: all ranks call it, after everything else. Returns the first one's code, for which the
/// others wait without work, as it may still write.
using EndRanks = int (*)(int code);
/// Ends all ranks at once with this exit code; any of them may call it at any time.
using AbortRanks = void (*)(int code);

/// The names of these functions in the module.
inline constexpr const char *start_ranks_name = "hemilux_start_ranks",
                            *end_ranks_name = "hemilux_end_ranks",
                            *abort_ranks_name = "hemilux_abort_ranks";

} // namespace hemilux
