#include "support/families/watchdog.h"

#include <chrono>

namespace hemilux::test {

Watchdog::Watchdog(Monitor& monitor, double seconds, std::uint64_t rays)
    : thread_([this, &monitor, seconds, rays] {
          using Clock = std::chrono::steady_clock;
          constexpr std::chrono::milliseconds between_looks(20);
          const Clock::time_point start = Clock::now();
          std::unique_lock lock(mutex_);
          while (!condition_.wait_for(lock, between_looks, [this] { return over_; })) {
              const std::chrono::duration<double> elapsed = Clock::now() - start;
              if (elapsed.count() > seconds || monitor.rays > rays)
                  monitor.interrupted.set_wished(true);
          }
      }) {}

Watchdog::~Watchdog() {
    {
        const std::lock_guard lock(mutex_);
        over_ = true;
    }
    condition_.notify_one();
    thread_.join();
}

} // namespace hemilux::test
