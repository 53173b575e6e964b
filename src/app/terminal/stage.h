#pragma once
// A stage of a run: the terminal shows its name, how long it lasts, and how much of it is done
// where that is known.

#include "app/settings/settings.h"
#include "app/terminal/live_line.h"
#include "parallel/stopwatch.h"
#include "radiosity/paper/solving/solver.h"

#include <atomic>
#include <string>

namespace hemilux {

/// Returns the line of a stage as text of at most `width` columns. A mark goes to and fro in its
/// bar.
[[nodiscard]] std::string stage_line(const std::string& name, double seconds, std::size_t width);
/// Returns it for a stage of which this share is done, with the time that the rest takes.
[[nodiscard]] std::string stage_line(const std::string& name, double share, double seconds,
                                     std::size_t width);

/// Shows the stage as long as it lives, unless the user wants quiet.
class Stage {
  public:
    Stage(std::string name, Verbosity verbosity);
    /// Shows how much of it is done besides, and how long the rest takes.
    Stage(std::string name, Verbosity verbosity, const std::atomic<double>& share);
    /// Shows the monitor's phases, one after the other, each with its share and its time.
    Stage(const Monitor& monitor, Verbosity verbosity);

  private:
    [[nodiscard]] std::string text(const Monitor& monitor, std::size_t columns);

    std::string name_;
    Stopwatch watch_;
    LiveLine line_;
};

} // namespace hemilux
