#include "app/terminal/live_line.h"

#include "app/terminal/wrap.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <poll.h>
#include <string_view>
#include <unistd.h>
#include <utility>
#include <vector>

namespace hemilux {
namespace {

constexpr auto redraw_interval = std::chrono::milliseconds(150);

/// The foot of the terminal, which all lines share.
struct Foot {
    std::mutex mutex;
    std::vector<const LiveLine*> lines; ///< the newest last
    bool drawn = false;

    void erase() {
        if (std::exchange(drawn, false)) {
            std::fputs("\r\033[K", stderr);
            std::fflush(stderr);
        }
    }
};

/// A terminal that is stopped must not stop what writes above the line, too.
bool takes_a_line() {
    pollfd asked{STDERR_FILENO, POLLOUT, 0};
    return poll(&asked, 1, 0) == 1 && (asked.revents & POLLOUT) != 0;
}

/// Is never destroyed: messages are written until the very end.
Foot& foot() {
    static Foot& only = *new Foot;
    return only;
}

} // namespace

bool stderr_is_terminal() {
    const char* const terminal = std::getenv("TERM");
    return isatty(STDERR_FILENO) && terminal && std::string_view(terminal) != "dumb";
}

LiveLine::LiveLine(bool shown, Text text) : text_(std::move(text)) {
    if (!shown)
        return;
    {
        const std::scoped_lock lock(foot().mutex);
        foot().lines.push_back(this);
    }
    thread_ = std::thread([this] { redraw_until_closed(); });
}

LiveLine::~LiveLine() { close(); }

void LiveLine::close() {
    if (!thread_.joinable())
        return;
    {
        const std::scoped_lock lock(foot().mutex);
        closed_ = true;
        std::erase(foot().lines, this);
        foot().erase();
    }
    wake_.notify_all();
    thread_.join();
}

void LiveLine::write_above(const std::function<void()>& write) {
    const std::scoped_lock lock(foot().mutex);
    foot().erase();
    write();
}

void LiveLine::redraw_until_closed() {
    std::unique_lock lock(foot().mutex);
    while (!wake_.wait_for(lock, redraw_interval, [this] { return closed_; })) {
        if (foot().lines.back() != this || !takes_a_line())
            continue;
        const std::string line = text_(terminal_columns(STDERR_FILENO) - 1);
        std::fprintf(stderr, "\r%s\033[K", line.c_str());
        std::fflush(stderr);
        foot().drawn = true;
    }
}

} // namespace hemilux
