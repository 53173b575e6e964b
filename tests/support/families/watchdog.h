#pragma once
// Ends a run that takes too long, also in the midst of a step.

#include "radiosity/paper/solving/solver.h"

#include <condition_variable>
#include <mutex>
#include <thread>

namespace hemilux::test {

class Watchdog {
  public:
    /// Sets the monitor's `interrupted` after so many seconds or rays.
    Watchdog(Monitor& monitor, double seconds, std::uint64_t rays);
    ~Watchdog();
    Watchdog(const Watchdog&) = delete;
    Watchdog& operator=(const Watchdog&) = delete;

  private:
    std::mutex mutex_;
    std::condition_variable condition_;
    bool over_ = false;
    std::thread thread_;
};

} // namespace hemilux::test
