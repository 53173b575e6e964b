#pragma once
// How many rows of a loop over all patches are done, for whoever watches.

#include "radiosity/paper/solving/solver.h"

#include <atomic>
#include <cstddef>

namespace hemilux {

class RowsDone {
  public:
    /// Begins a phase of the monitor, which gets its share of `rows`.
    RowsDone(Monitor& monitor, const char* phase, std::size_t rows)
        : monitor_(monitor), rows_(static_cast<double>(rows)) {
        monitor.step_share = 0;
        monitor.phase = phase;
    }
    /// Adds rows that are done; may be called from several threads.
    void add(std::size_t count) {
        monitor_.step_share = static_cast<double>(done_ += count) / rows_;
    }

  private:
    Monitor& monitor_;
    double rows_;
    std::atomic<std::size_t> done_{0};
};

} // namespace hemilux
