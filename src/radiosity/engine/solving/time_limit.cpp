#include "radiosity/engine/solving/time_limit.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stop_token>

namespace hemilux {

TimeLimit::TimeLimit(StopFlag& flag, std::optional<double> seconds) : flag_(flag) {
    if (!seconds)
        return;
    constexpr double longest = 1e8; // three years, which a clock can add to its time
    const std::chrono::duration<double> span(std::clamp(*seconds, 0.0, longest));
    waiting_ = std::jthread([&flag, span](const std::stop_token& ended) {
        std::mutex mutex;
        std::condition_variable_any never; // only the end wakes it
        std::unique_lock lock(mutex);
        never.wait_for(lock, ended, span, [] { return false; });
        if (!ended.stop_requested())
            flag.set_out_of_time(true);
    });
}

TimeLimit::~TimeLimit() {
    if (!waiting_.joinable())
        return;
    waiting_.request_stop();
    waiting_.join();
    flag_.set_out_of_time(false);
}

} // namespace hemilux
