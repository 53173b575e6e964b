#pragma once
// A time limit that also holds within a step.

#include "radiosity/solving/stop_flag.h"

#include <optional>
#include <thread>

namespace hemilux {

/// While it lives, it sets the flag's out_of_time() once `seconds` have passed. Without a number it
/// does nothing. The flag outlives it.
class TimeLimit {
  public:
    TimeLimit(StopFlag& flag, std::optional<double> seconds);
    ~TimeLimit();

  private:
    StopFlag& flag_;
    std::jthread waiting_;
};

} // namespace hemilux
