#pragma once
// The progress bar: a line on the terminal, drawn from the solver's monitor.

#include "app/terminal/live_line.h"
#include "radiosity/engine/solving/method.h"
#include "radiosity/engine/solving/run.h"

#include <chrono>
#include <functional>
#include <limits>
#include <mutex>
#include <string>

namespace hemilux {

/// The state that the bar shows.
struct ProgressState {
    const char* phase = "";
    std::string topic{};     ///< what it works on; may be empty
    std::uint32_t steps = 0; ///< finished
    double step_share = 0;   ///< share of the present step that is done, 0 to 1
    double seconds = 0;      ///< time since the start
    std::uint64_t rays = 0;
    std::uint64_t rays_of_steps = 0; ///< rays of the finished ones
    std::uint64_t rays_of_step = 0;  ///< rays of the present one
    double estimated_error = std::numeric_limits<double>::quiet_NaN(); ///< NaN: not known yet
};

/// Returns how much of the run is done, 0 to 1, by the part of the stop rule that will be met
/// first. The error is taken to fall as rays^-1/2, or as rays^-.7 where points are well
/// distributed.
[[nodiscard]] double share_done(const StopRule& stop, bool well_distributed,
                                const ProgressState& state);

/// This returns how much of the work is done, 0 to 1.
using ShareDone = std::function<double(const ProgressState&)>;
/// Returns the share of one run that is done.
[[nodiscard]] ShareDone share_of(const StopRule& stop, const Method& method);

/// Returns the bar of a share of work, with its per cent.
[[nodiscard]] std::string share_bar(double share);
/// Returns how long the rest takes where this share took these seconds, as ", 5 s left"; empty
/// while too little is done to tell.
[[nodiscard]] std::string time_left(double share, double seconds);

/// Returns the bar as text of at most `width` columns.
[[nodiscard]] std::string progress_line(double share, const ProgressState& state,
                                        std::size_t width);

class Progress {
  public:
    /// Begins the display, where there is a bar.
    Progress(const Monitor& monitor, ShareDone share, bool bar);

    void step_done(const StepRecord& record);
    /// Sets what stands before the phase.
    void set_topic(const std::string& topic);
    /// Takes the bar away for good.
    void close() { line_.close(); }

  private:
    [[nodiscard]] std::string text(std::size_t columns);

    const Monitor& monitor_;
    ShareDone share_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    ProgressState state_;
    std::uint64_t rays_before_step_ = 0; ///< the monitor's count
    std::mutex mutex_;
    LiveLine line_;
};

} // namespace hemilux
