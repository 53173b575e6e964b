#pragma once
// Limits the time of a run, also within a step.

#include "radiosity/paper/solving/stop_flag.h"

#include <optional>
#include <thread>

namespace hemilux {

/// A limit that, while it lives, makes the flag out of time once `seconds` have passed. Without
/// a number it does nothing. The flag outlives it.
class TimeLimit {
  public:
    TimeLimit(StopFlag& flag, std::optional<double> seconds);
    ~TimeLimit();

  private:
    StopFlag& flag_;
    std::jthread waiting_;
};

} // namespace hemilux
