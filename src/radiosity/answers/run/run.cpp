#include "radiosity/answers/run/run.h"

#include "parallel/stopwatch.h"
#include "radiosity/answers/run/step_size.h"
#include "radiosity/engine/emitters/lit_by_points.h"
#include "radiosity/engine/solving/shared_stop.h"
#include "radiosity/engine/solving/time_limit.h"

#include <algorithm>
#include <utility>

namespace hemilux {
namespace {

/// The bytes that a method may keep rays in where no limit is given: a scene of a million patches
/// then stays within 3 GB.
constexpr std::uint64_t default_memory = std::uint64_t{3} << 29;

/// The time [s] after which a run ends that has learned nothing (StopRule::patience), if nothing
/// else ends it.
constexpr double default_patience = 60;

} // namespace

std::uint64_t memory_of_solver(const MemoryShare& share) {
    if (!share.limit)
        return default_memory;
    const auto limit = static_cast<double>(*share.limit);
    const double left = std::clamp(limit - share.needed, 1.0, std::max(limit / 2, 1.0));
    return static_cast<std::uint64_t>(left / static_cast<double>(share.solvers)) + 1;
}

std::uint64_t default_max_rays(std::size_t patches) {
    constexpr std::uint64_t least = 100'000'000, each = 1000;
    return least + each * patches;
}

StopRule stop_rule(const RunChoices& choices, std::size_t patches) {
    const MethodWork work = choices.work();
    StopRule stop = choices.stop;
    if (choices.sampling && (stop.error || (!stop.steps && !stop.seconds)))
        stop.error = choices.sampling;
    if (!stop.steps && !stop.seconds && !stop.error && !choices.until_useful) {
        stop = choices.method->default_stop;
        stop.rays = choices.stop.rays;
        if (work.ends_by_itself)
            stop.steps.reset();
        else if (!stop.steps && !stop.seconds && !stop.error)
            stop.steps = StopRule::default_steps;
    }
    if (!stop.steps && !stop.seconds && !stop.rays && work.estimates_error) {
        stop.rays = default_max_rays(patches);
        stop.patience = default_patience;
    }
    return stop;
}

void Run::add_time_before(double more) {
    for (StepRecord& record : steps)
        record.seconds += more;
    before.seconds += more;
}

Run begin(std::shared_ptr<const Problem> problem, const RunChoices& choices, Monitor& monitor) {
    const std::size_t patches = problem->mesh->patches().size();
    SolveOptions options = choices.options;
    options.memory = memory_of_solver(choices.memory);
    options.rays = rays_of_step(options.rays, choices.stop.seconds, *choices.method, patches);
    options.stop = stop_rule(choices, patches);
    return begin(std::move(problem), *choices.method, std::move(options), choices.plain, monitor);
}

Run begin(std::shared_ptr<const Problem> problem, const Method& method, SolveOptions options,
          bool plain, Monitor& monitor) {
    const Stopwatch preparing;
    Run run{.problem = std::move(problem),
            .options = std::make_unique<const SolveOptions>(std::move(options)),
            .solver = nullptr,
            .monitor = &monitor};
    run.solver = make_solver(method, run.input(), plain);
    run.seconds = ranks_of(monitor.interrupted).of_first(preparing.seconds());
    return run;
}

bool take_step(Run& run, std::optional<double> seconds) {
    StopFlag& interrupted = run.monitor->interrupted;
    const Stopwatch stepping;
    const TimeLimit limit(interrupted, seconds);
    if (agree(interrupted) || !run.solver->step())
        return false;
    run.seconds += ranks_of(interrupted).of_first(stepping.seconds());
    const Solution& solution = run.solution();
    run.steps.push_back({run.before.steps + 1, solution.rays_energy + solution.rays_density,
                         run.seconds, estimated_error(run.mesh(), solution)});
    run.before = {run.steps.back().step, run.seconds};
    return true;
}

void go_on(Run& run, const StopRule& stop, RunWatcher& watcher) {
    const Stopwatch solving;
    const auto count = [&] { run.seconds += solving.seconds(); };
    const auto after_step = [&](const StepRecord& record, const Solution& solution) {
        run.steps.push_back(record);
        run.before = {record.step, record.seconds};
        watcher.step_done(record, solution);
    };
    const auto useful = [&](const Solution& solution) { return watcher.is_useful(solution); };
    const Before before = run.before; // which each step changes
    try {
        run.completed = hemilux::run(*run.solver, run.input(), stop, after_step, before, useful);
    } catch (...) {
        count();
        throw;
    }
    count();
}

Run solve(std::shared_ptr<const Problem> problem, const RunChoices& choices, Monitor& monitor,
          RunWatcher& watcher) {
    Run run = begin(std::move(problem), choices, monitor);
    go_on(run, stop_rule(choices, run.mesh().patches().size()), watcher);
    return run;
}

} // namespace hemilux
