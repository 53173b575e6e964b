#pragma once
// Limits the time of a run, also within a step.

#include "radiosity/paper/solving/stop_flag.h"

#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

namespace hemilux {

/// A limit that, while it lives, makes the flag out of time once `seconds` have passed. Without a
/// number it does nothing.
class TimeLimit {
  public:
    TimeLimit(StopFlag& flag, std::optional<double> seconds);
    ~TimeLimit();

  private:
    StopFlag& flag_;
    std::mutex mutex_;
    std::condition_variable end_; ///< only the end wakes who waits
    bool ended_ = false;
    std::thread waiting_;
};

} // namespace hemilux
