#include "radiosity/engine/solving/time_limit.h"

#include "radiosity/engine/solving/shared_stop.h"

#include <algorithm>
#include <chrono>

namespace hemilux {

TimeLimit::TimeLimit(StopFlag& flag, std::optional<double> seconds) : flag_(flag) {
    if (!seconds)
        return;
    constexpr double longest = 1e8; // three years, which a clock can add to its time
    const std::chrono::duration<double> span(std::clamp(*seconds, 0.0, longest));
    waiting_ = std::thread([this, span] {
        std::unique_lock lock(mutex_);
        if (!end_.wait_for(lock, span, [this] { return ended_; }))
            flag_.set_out_of_time(true);
    });
}

TimeLimit::~TimeLimit() {
    if (!waiting_.joinable())
        return;
    {
        const std::lock_guard lock(mutex_);
        ended_ = true;
    }
    end_.notify_one();
    waiting_.join();
    end_time_limit(flag_);
}

} // namespace hemilux
