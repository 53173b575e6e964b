#include "app/talk.h"

#include "app/text.h"
#include "io/printable.h"

#include <cstdio>

namespace hemilux {

namespace {

constexpr std::size_t most_warnings = 10;

} // namespace

void say(Talk wanted, Talk least, const std::string& line) {
    if (wanted >= least)
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
