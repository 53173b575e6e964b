#pragma once
// The question whether the user asked the program to end, and what work throws that ends early.

#include <atomic>
#include <stdexcept>

namespace hemilux {

/// Work was left undone, or a file left out, because the user asked the program to end.
class Interrupted : public std::runtime_error {
  public:
    Interrupted() : std::runtime_error("interrupted") {}
};

/// Returns the flag that a signal sets. What works for long asks by this, often enough that it
/// stops within a fraction of a second. With HEMILUX_SIGNAL_AT=N in the environment, this process
/// gets a SIGINT by the Nth question: so a test interrupts the same work each time.
[[nodiscard]] bool is_asked_to_end(const std::atomic<bool>& flag);

} // namespace hemilux
