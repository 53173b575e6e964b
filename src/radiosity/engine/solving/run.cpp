#include "radiosity/engine/solving/run.h"

#include "radiosity/engine/solving/engine_solver.h"
#include "radiosity/engine/solving/shared_stop.h"
#include "radiosity/engine/solving/time_limit.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace hemilux {
namespace {

/// The largest ratio that is expected of the time of a step to that of the longest before, where
/// steps grow.
constexpr double max_growth = 2;

/// The least time [s] that a run gives its steps, so that the shortest limit is enough for one.
constexpr double min_seconds = 1;

} // namespace

bool run(Solver& solver, const SolverInput& input, const StopRule& stop,
         const std::function<void(const StepRecord&, const Solution&)>& after_step,
         const Before& before, const std::function<bool(const Solution& image)>& useful) {
    auto* const planned = dynamic_cast<EngineSolver*>(&solver); // a page plans nothing
    if (planned && stop.error)
        planned->aim_at(*stop.error);
    const auto start = std::chrono::steady_clock::now();
    const auto elapsed = [&] {
        const std::chrono::duration<double> d = std::chrono::steady_clock::now() - start;
        return ranks_of(input.monitor.interrupted)
            .of_first(solver.solution().seconds_density + before.seconds + d.count());
    };
    double last = elapsed(), longest = 0, growth = 1;
    const auto done = [&](std::uint32_t step, double seconds, double error) {
        return solver.finished() || (stop.steps && step >= *stop.steps) ||
               (stop.error && error <= *stop.error) ||
               (stop.rays && solver.solution().rays_energy >= *stop.rays) ||
               // A step that would end too late is not begun.
               (stop.seconds && seconds + growth * longest > *stop.seconds);
    };
    if (before.steps > 0 &&
        done(before.steps, last, estimated_error(input.mesh, solver.solution())))
        return true;
    std::optional<double> time_left;
    if (stop.seconds)
        time_left = std::max(*stop.seconds - last, min_seconds);
    StopFlag& interrupted = input.monitor.interrupted;
    const TimeLimit limit(interrupted, time_left);
    double error = std::numeric_limits<double>::quiet_NaN();
    for (std::uint32_t step = before.steps + 1;; ++step) {
        // Steps grow: the next one alone may last far longer than patience does.
        std::optional<double> patience;
        if (stop.patience && !std::isfinite(error) && step > StopRule::steps_of_patience &&
            !stop.seconds)
            patience = std::max(*stop.patience - last, min_seconds);
        const TimeLimit limit_of_patience(interrupted, patience);
        const bool is_to_end = agree(interrupted) && !(planned && planned->steps_ready() > 0);
        if (is_to_end || !solver.step())
            return !interrupted.is_wished(); // but for the caller's wish the run ends by its rule
        const Solution& solution = solver.solution();
        error = estimated_error(input.mesh, solution);
        const StepRecord record{step, solution.rays_energy + solution.rays_density, elapsed(),
                                error};
        if (after_step)
            after_step(record, solution);
        const double took = record.seconds - last;
        growth = longest > 0 ? std::clamp(took / longest, 1.0, max_growth) : 1;
        longest = std::max(longest, took);
        last = record.seconds;
        if (done(step, record.seconds, record.estimated_error) ||
            (useful && ranks_of(interrupted).of_first(useful(solution) ? 1. : 0.) > 0))
            return true;
        if (patience && !std::isfinite(error) && record.seconds > *stop.patience)
            return true;
    }
}

} // namespace hemilux
