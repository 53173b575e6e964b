#include "app/terminal/stage.h"

#include "app/terminal/progress.h"
#include "radiosity/answers/asked/text.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hemilux {

std::string stage_line(const std::string& name, double seconds, std::size_t width) {
    constexpr std::size_t cells = 24, mark = 4, ways = cells - mark;
    constexpr double steps_per_second = 7;
    const auto turn = static_cast<std::size_t>(std::fmod(steps_per_second * seconds, 2.0 * ways));
    std::string bar(cells, '.');
    bar.replace(turn <= ways ? turn : 2 * ways - turn, mark, mark, '#');
    return ("[" + bar + "] " + name + "  " + duration(seconds)).substr(0, width);
}

std::string stage_line(const std::string& name, double share, double seconds, std::size_t width) {
    const std::string left = seconds > 0 ? time_left(share, seconds) : "";
    return (share_bar(share) + name + "  " + duration(seconds) + left).substr(0, width);
}

Stage::Stage(std::string name, Verbosity verbosity)
    : name_(std::move(name)),
      line_(verbosity != Verbosity::quiet && stderr_is_terminal(),
            [this](std::size_t columns) { return stage_line(name_, watch_.seconds(), columns); }) {}

Stage::Stage(std::string name, Verbosity verbosity, const std::atomic<double>& share)
    : name_(std::move(name)),
      line_(verbosity != Verbosity::quiet && stderr_is_terminal(), [this,
                                                                    &share](std::size_t columns) {
          return stage_line(name_, std::clamp(share.load(), 0.0, 1.0), watch_.seconds(), columns);
      }) {}

Stage::Stage(const Monitor& monitor, Verbosity verbosity)
    : name_(monitor.phase.load()),
      line_(verbosity != Verbosity::quiet && stderr_is_terminal(),
            [this, &monitor](std::size_t columns) { return text(monitor, columns); }) {}

std::string Stage::text(const Monitor& monitor, std::size_t columns) {
    const char* const phase = monitor.interrupted ? "stopping" : monitor.phase.load();
    double seconds = watch_.seconds();
    if (name_ != phase) {
        name_ = phase;
        watch_ = {};
        seconds = 0;
    }
    return stage_line(name_, std::clamp(monitor.step_share.load(), 0.0, 1.0), seconds, columns);
}

} // namespace hemilux
