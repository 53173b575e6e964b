#include "app/terminal/log.h"

#include "app/terminal/live_line.h"
#include "app/terminal/wrap.h"
#include "io/files/atomic_file.h"
#include "io/files/printable.h"
#include "radiosity/answers/asked/text.h"

#include <atomic>
#include <cstdio>
#include <unistd.h>

namespace hemilux {

bool can_log() {
    static std::atomic<bool> gave_up{false};
    if (!gave_up && !wait_until_writable(STDERR_FILENO))
        gave_up = true;
    return !gave_up;
}

void write_message(const std::string& text) {
    LiveLine::write_above(
        [&] { std::fprintf(stderr, "%s\n", message_for(STDERR_FILENO, text).c_str()); });
}

void log_line(Verbosity wanted, Verbosity least, const std::string& line) {
    if (wanted >= least && can_log())
        write_message(line);
}

void log_path(Verbosity wanted, Verbosity least, const std::string& verb, const std::string& path) {
    if (wanted >= least && can_log())
        LiveLine::write_above([&] {
            std::fprintf(stderr, "%s %s\n", verb.c_str(),
                         printable_message(single_line(path)).c_str());
        });
}

void log_warnings(Verbosity wanted, const std::vector<std::string>& warnings) {
    constexpr std::size_t max_warnings = 10;
    const bool all = wanted == Verbosity::verbose || warnings.size() <= max_warnings;
    const std::size_t shown = all ? warnings.size() : max_warnings;
    for (std::size_t i = 0; i < shown; ++i)
        log_line(wanted, Verbosity::normal, "warning: " + single_line(warnings[i]));
    if (!all)
        log_line(wanted, Verbosity::normal,
                 formatted("warning: and %zu more (-v shows all)", warnings.size() - shown));
}

} // namespace hemilux
