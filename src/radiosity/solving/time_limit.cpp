#include "radiosity/solving/time_limit.h"

#include <algorithm>
#include <chrono>

namespace hemilux {

TimeLimit::TimeLimit(StopFlag& flag, std::optional<double> seconds) : flag_(flag) {
    if (seconds)
        waiting_ = std::thread([this, seconds] { wait(*seconds); });
}

TimeLimit::~TimeLimit() {
    if (!waiting_.joinable())
        return;
    {
        const std::lock_guard lock(mutex_);
        ended_ = true;
    }
    changed_.notify_one();
    waiting_.join();
    flag_.set_out_of_time(false);
}

void TimeLimit::wait(double seconds) {
    constexpr double longest = 1e8; // three years, which a clock can add to its time
    const std::chrono::duration<double> span(std::clamp(seconds, 0.0, longest));
    std::unique_lock lock(mutex_);
    if (!changed_.wait_for(lock, span, [&] { return ended_; }))
        flag_.set_out_of_time(true);
}

} // namespace hemilux
