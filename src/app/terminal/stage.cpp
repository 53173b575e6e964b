#include "app/terminal/stage.h"

#include "app/settings/text.h"

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

Stage::Stage(std::string name, Verbosity verbosity)
    : name_(std::move(name)),
      line_(verbosity != Verbosity::quiet && stderr_is_terminal(),
            [this](std::size_t columns) { return stage_line(name_, watch_.seconds(), columns); }) {}

} // namespace hemilux
