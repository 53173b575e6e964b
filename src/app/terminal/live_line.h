#pragma once
// A line at the foot of the terminal that a thread of its own redraws a few times a second. There
// may be several, of which the newest is shown. What stays is written above it.

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace hemilux {

/// Returns whether stderr is a terminal that can redraw a line.
[[nodiscard]] bool stderr_is_terminal();

class LiveLine {
  public:
    /// Returns the line, of at most so many columns.
    using Text = std::function<std::string(std::size_t columns)>;

    /// Begins the display; without `shown` nothing is ever drawn.
    LiveLine(bool shown, Text text);
    ~LiveLine();
    LiveLine(const LiveLine&) = delete;
    LiveLine& operator=(const LiveLine&) = delete;

    /// Takes the line away for good.
    void close();

    /// Takes what is drawn away and lets `write` write to stderr.
    static void write_above(const std::function<void()>& write);

  private:
    void redraw_until_closed();

    Text text_;
    std::condition_variable wake_;
    bool closed_ = false;
    std::thread thread_;
};

} // namespace hemilux
