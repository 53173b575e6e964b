#include "app/terminal/talk.h"

#include "app/settings/text.h"
#include "io/files/atomic_file.h"
#include "io/files/printable.h"

#include <atomic>
#include <cstdio>
#include <unistd.h>

namespace hemilux {

namespace {

constexpr std::size_t most_warnings = 10;

} // namespace

bool can_say() {
    static std::atomic<bool> gave_up{false};
    if (!gave_up && !wait_until_writable(STDERR_FILENO))
        gave_up = true;
    return !gave_up;
}

void say(Talk wanted, Talk least, const std::string& line) {
    if (wanted >= least && can_say())
        std::fprintf(stderr, "%s\n", printable_message(line).c_str());
}

void say_warnings(Talk wanted, const std::vector<std::string>& warnings) {
    const bool all = wanted == Talk::verbose || warnings.size() <= most_warnings;
    const std::size_t shown = all ? warnings.size() : most_warnings;
    for (std::size_t i = 0; i < shown; ++i)
        say(wanted, Talk::normal, "warning: " + warnings[i]);
    if (!all)
        say(wanted, Talk::normal,
            formatted("warning: and %zu more (-v shows all)", warnings.size() - shown));
}

} // namespace hemilux
