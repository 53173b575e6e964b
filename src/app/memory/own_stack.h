#pragma once
// The stack of the program's threads, whatever `ulimit -s` leaves. Rays that are traced together
// have their states on it, and so have functions that call themselves: some hundred kilobytes.

#include <functional>

namespace hemilux {

/// Calls `run` on a stack that is large enough, by a thread of its own where the limit of this one
/// is too small, and gives all threads that start later as much. `run` must not throw.
[[nodiscard]] int on_own_stack(const std::function<int()>& run);

} // namespace hemilux
