#pragma once
// A time limit that also holds within a step.

#include "radiosity/solving/stop_flag.h"

#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

namespace hemilux {

/// While it lives, it sets the flag's out_of_time() once `seconds` have passed. Without a number it
/// does nothing. The flag outlives it.
class TimeLimit {
  public:
    TimeLimit(StopFlag& flag, std::optional<double> seconds);
    ~TimeLimit();
    TimeLimit(const TimeLimit&) = delete;
    TimeLimit& operator=(const TimeLimit&) = delete;

  private:
    void wait(double seconds);

    StopFlag& flag_;
    std::mutex mutex_;
    std::condition_variable changed_;
    bool ended_ = false;
    std::thread waiting_;
};

} // namespace hemilux
