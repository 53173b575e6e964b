#pragma once
// Ctrl-C. The first one asks the solver to stop, so that what was computed is still written; the
// second one ends the program at once.

#include <atomic>

namespace hemilux {

/// While it lives, SIGINT sets the flag; one at a time.
class InterruptGuard {
  public:
    explicit InterruptGuard(std::atomic<bool>& flag);
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;
};

} // namespace hemilux
