#pragma once
// Calls that take long: they run on a thread of their own while Python's other threads go on, and
// Ctrl-C ends them.

#include "radiosity/paper/solving/solver.h"

#include <pybind11/pybind11.h>

#include <functional>

namespace hemilux {

/// Runs `work`, which ends early once the monitor is interrupted, without Python's lock. Meanwhile
/// it looks for signals, and calls `progress(phase, share)` a few times a second unless it is None.
/// Throws what the work throws, and what a signal or `progress` raised, KeyboardInterrupt for one.
void run_without_lock(Monitor& monitor, const pybind11::object& progress,
                      const std::function<void()>& work);

} // namespace hemilux
