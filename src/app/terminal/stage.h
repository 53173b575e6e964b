#pragma once
// A stage of a run whose end is not known: the terminal shows its name, and how long it lasts.

#include "app/settings/settings.h"
#include "app/terminal/live_line.h"
#include "app/terminal/stopwatch.h"

#include <string>

namespace hemilux {

/// Returns the line of a stage as text of at most `width` columns. A mark goes to and fro in its
/// bar.
[[nodiscard]] std::string stage_line(const std::string& name, double seconds, std::size_t width);

/// Shows the stage as long as it lives, unless the user wants quiet.
class Stage {
  public:
    Stage(std::string name, Verbosity verbosity);

  private:
    std::string name_;
    Stopwatch watch_;
    LiveLine line_;
};

} // namespace hemilux
