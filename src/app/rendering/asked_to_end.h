#pragma once
// The question whether the user asked the program to end.

#include <atomic>

namespace hemilux {

/// Returns the flag that a signal sets. What works for long asks by this, often enough that it
/// stops within a fraction of a second. With HEMILUX_SIGNAL_AT=N in the environment, this process
/// gets a SIGINT by the Nth question: so a test interrupts the same work each time.
[[nodiscard]] bool is_asked_to_end(const std::atomic<bool>& flag);

} // namespace hemilux
