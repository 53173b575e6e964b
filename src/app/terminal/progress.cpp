#include "app/terminal/progress.h"

#include "radiosity/answers/asked/text.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hemilux {

namespace {

constexpr std::size_t bar_cells = 24;

} // namespace

double share_done(const StopRule& stop, bool well_distributed, const ProgressState& state) {
    const double steps = state.steps + std::clamp(state.step_share, 0.0, 1.0);
    double share = 0;
    if (stop.steps)
        share = std::max(share, steps / *stop.steps);
    if (stop.seconds)
        share = std::max(share, state.seconds / *stop.seconds);
    if (stop.error && state.steps > 0 && state.estimated_error > 0) {
        const double growth =
            std::pow(state.estimated_error / *stop.error, well_distributed ? 1 / .7 : 2);
        share = std::max(share, static_cast<double>(state.rays_of_steps + state.rays_of_step) /
                                    (growth * static_cast<double>(state.rays_of_steps)));
    }
    return std::min(share, 1.0);
}

ShareDone share_of(const StopRule& stop, const Method& method) {
    return [stop, &method](const ProgressState& state) {
        return share_done(stop, !method.unbiased, state);
    };
}

std::string share_bar(double share) {
    const auto full = static_cast<std::size_t>(share * bar_cells);
    return "[" + std::string(full, '#') + std::string(bar_cells - full, '.') + "]" +
           formatted(" %3.0f %%  ", std::floor(100 * share));
}

std::string time_left(double share, double seconds) {
    constexpr double least = .02; // the first few per cent say little about the rest
    return share > least ? ", " + duration(seconds * (1 - share) / share) + " left" : "";
}

std::string progress_line(double share, const ProgressState& state, std::size_t width) {
    std::string line =
        share_bar(share) + state.topic + (state.topic.empty() ? "" : ", ") + state.phase;
    if (state.seconds > 0)
        line += "  " + short_count(static_cast<double>(state.rays) / state.seconds) + " rays/s";
    line += "  " + duration(state.seconds) + time_left(share, state.seconds);
    if (std::isfinite(state.estimated_error))
        line += "  error " + percent(state.estimated_error);
    return line.substr(0, width);
}

Progress::Progress(const Monitor& monitor, ShareDone share, bool bar)
    : monitor_(monitor), share_(std::move(share)),
      line_(bar, [this](std::size_t columns) { return text(columns); }) {}

void Progress::step_done(const StepRecord& record) {
    const std::scoped_lock lock(mutex_);
    state_.steps = record.step;
    state_.rays_of_steps = record.rays;
    rays_before_step_ = monitor_.rays;
    state_.estimated_error = record.estimated_error;
}

void Progress::set_topic(const std::string& topic) {
    const std::scoped_lock lock(mutex_);
    state_.topic = topic;
}

std::string Progress::text(std::size_t columns) {
    const std::scoped_lock lock(mutex_);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
    state_.seconds = elapsed.count();
    state_.rays = monitor_.rays;
    state_.rays_of_step = state_.rays - rays_before_step_;
    state_.step_share = monitor_.step_share;
    state_.phase = monitor_.interrupted ? "stopping" : monitor_.phase.load();
    return progress_line(share_(state_), state_, columns);
}

} // namespace hemilux
