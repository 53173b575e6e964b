#include "radiosity/answers/division/division.h"

#include "geometry/elementary.h"
#include "parallel/stopwatch.h"
#include "parallel/workers.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/engine/solving/time_limit.h"
#include "radiosity/paper/sampling/rng.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hemilux {
namespace {

/// The share of the time of a run that the division may take.
constexpr double share_of_time = .5;

/// A goal is set lower by a factor in this range, with some room.
constexpr double safe = .9, min_step = .5, max_step = .9;

/// The number of times that the division goes on where the whole error is still too large.
constexpr unsigned max_attempts = 8;

/// Rays to find out the error of the division: at most as many as all before, but so many are
/// always worth it.
constexpr std::uint64_t min_rays_of_error = 1'600'000, rough_rays_of_error = 400'000;

/// The bytes that stored transport takes for a patch, and the patch with its outputs.
constexpr std::uint64_t bytes_of_patch = 16'384;

AdaptiveDivision options_of(const RunChoices& run, const DivisionChoices& choices,
                            std::size_t patches) {
    AdaptiveDivision options{.error = share_of_division * choices.error,
                             .max_patches = choices.max_patches,
                             .seed = run.options.seed,
                             .threads = run.options.threads,
                             .keep_all = run.options.keep_all};
    if (run.stop.rays)
        options.max_rays = *run.stop.rays;
    if (run.memory.limit) {
        options.memory = *run.memory.limit / 2;
        options.max_patches = std::clamp<std::size_t>(*run.memory.limit / bytes_of_patch, patches,
                                                      std::max(patches, options.max_patches));
    }
    return options;
}

std::string round_text(const DivisionRound& round) {
    return "division: " + counted(round.patches, "patch", "patches") + ", within them the light " +
           "differs by about " + percent(round.error);
}

/// Divides the mesh for a run to come.
class AutoDivision {
  public:
    AutoDivision(Problem problem, const RunChoices& run, const DivisionChoices& choices,
                 Monitor& monitor, Watcher& watcher)
        : problem_(std::make_shared<Problem>(std::move(problem))), mesh_(*problem_->mesh),
          choices_(run), standard_(*choices.standard), monitor_(monitor), watcher_(watcher),
          options_(options_of(run, choices, mesh_.patches().size())), whole_(choices.error),
          is_own_(run.method == choices.standard && !run.plain) {
        divided_.problem = problem_;
    }

    [[nodiscard]] Divided divide();

  private:
    /// Finds the light of the mesh as it is: by the run to come, where that is of the standard
    /// method.
    void run_to(double error, const StopRule& most);
    /// Measures how far the light of patches is off by the division, at points of its own.
    void measure(DivisionErrorOptions options);
    void divide_once(Division& division);
    void divide_until_enough();
    /// Returns whether the whole error, as far as it is known, is as asked for. If it is not, less
    /// is left to what has the larger part.
    [[nodiscard]] bool is_enough(double sampling);
    [[nodiscard]] bool is_confirmed(double sampling, std::span<const double> square);
    [[nodiscard]] bool is_over() const { return monitor_.interrupted || divided_.rough.steps == 0; }
    void forget_run();
    [[nodiscard]] DivisionWork& work() { return divided_.work; }

    std::shared_ptr<Problem> problem_;
    Mesh& mesh_;
    const RunChoices& choices_;
    const Method& standard_;
    Monitor& monitor_;
    Watcher& watcher_;
    AdaptiveDivision options_;
    double whole_;
    bool is_own_;
    std::uint64_t gathers_ = 0;
    bool divides_ = true;    ///< in the next attempt
    unsigned divisions_ = 0; ///< attempts that divided
    Divided divided_;
};

void AutoDivision::run_to(double error, const StopRule& most) {
    if (!divided_.run && is_own_)
        divided_.run = begin(problem_, choices_, monitor_);
    else if (!divided_.run) {
        SolveOptions options = choices_.options;
        options.memory = memory_of_solver(choices_.memory);
        divided_.run = begin(problem_, standard_, std::move(options), false, monitor_);
    }
    StopRule stop = most;
    stop.error = error;
    if (is_own_)
        stop.steps = choices_.stop.steps;
    RunWatcher nobody;
    go_on(*divided_.run, stop, nobody);
    divided_.rough = divided_.run->solution();
    divided_.steps = divided_.run->steps.size();
}

void AutoDivision::forget_run() {
    if (divided_.run)
        work().rays += divided_.run->solution().rays_energy;
    divided_.run.reset();
    divided_.steps = 0;
}

void AutoDivision::measure(DivisionErrorOptions options) {
    options.seed = hash_words({choices_.options.seed, 4, gathers_++});
    const Stopwatch watch;
    const Workers workers(choices_.options.threads);
    const DivisionError found = division_error(mesh_, *problem_->tracer, divided_.rough, options,
                                               workers, monitor_.interrupted);
    divided_.error = found;
    work().rays_error += found.rays;
    work().seconds_error += watch.seconds();
}

/// Returns whether it is enough. What is left is aimed at with some room, as what was found is
/// known to a tenth.
bool AutoDivision::is_enough(double sampling) {
    constexpr double min_sampling = .6;
    const double division = divided_.error->error;
    if (elementary::hypot(division, sampling) <= whole_)
        return true;
    const auto left = [&](double other) {
        return safe * std::sqrt(std::max(whole_ * whole_ - other * other, 0.0));
    };
    divides_ = left(division) < min_sampling * *divided_.sampling;
    if (divides_)
        options_.error *= std::clamp(left(sampling) / division, min_step, max_step);
    else
        divided_.sampling = std::min(left(division), max_step * *divided_.sampling);
    return false;
}

/// Measures the error of patches that were divided just now; others keep theirs. The first of
/// several errors to be small enough errs low, so it is confirmed at other points.
bool AutoDivision::is_confirmed(double sampling, std::span<const double> square) {
    const std::uint64_t before = divided_.rough.rays_energy + work().rays;
    const DivisionErrorOptions options{.max_rays = std::max(before, min_rays_of_error),
                                       .negligible = sampling / 2,
                                       .expected = share_of_division * whole_,
                                       .square = square};
    const bool is_new = std::exchange(divides_, false);
    if (is_new)
        measure(options);
    if (is_over() || !is_enough(sampling))
        return false;
    if (is_new && divisions_ > 1)
        measure(options);
    return !is_over() && is_enough(sampling);
}

void AutoDivision::divide_once(Division& division) {
    if (!division.divide(divided_.rough, options_.error, [&](const DivisionRound& round) {
            work().rays += round.rays;
            watcher_.tell(Finding::Kind::detail, round_text(round));
        }))
        return;
    forget_run(); // which refers to what changes
    problem_->find_again();
}

/// Where rays are limited, the division may take half of them.
void AutoDivision::divide_until_enough() {
    const std::uint64_t max_rays =
        choices_.stop.rays.value_or(default_max_rays(mesh_.patches().size()));
    const auto spent = [&] { return work().rays + work().rays_error; };
    if (choices_.stop.rays)
        options_.max_rays =
            max_rays / 2 - std::min(spent() + divided_.rough.rays_energy, max_rays / 2);
    Division division(mesh_, *problem_->tracer, options_, monitor_);
    for (unsigned attempt = 0; attempt < max_attempts; ++attempt) {
        if (divides_) {
            divide_once(division);
            ++divisions_;
        }
        if (is_over())
            break;
        StopRule stop;
        stop.rays = max_rays - std::min(spent(), max_rays);
        run_to(*divided_.sampling, stop);
        if (is_over())
            break;
        work().rays += division.add_slopes(divided_.rough, options_.error);
        const double sampling = estimated_error(mesh_, divided_.rough);
        const bool is_aimed_at = sampling <= *divided_.sampling; // else by rays or steps
        const bool done = is_confirmed(sampling, division.squares()) || !is_aimed_at;
        if (is_over() || done || divided_.rough.rays_energy + spent() > max_rays)
            break;
        division.doubt();
    }
    divided_.slope = division.slopes();
}

Divided AutoDivision::divide() {
    const Stopwatch watch;
    const StopRule rough = rough_stop(options_, mesh_.patches().size());
    divided_.sampling = share_of_sampling * whole_;
    run_to(*rough.error, rough);
    if (!is_over()) {
        measure({.max_rays = rough_rays_of_error, .negligible = share_of_division * whole_});
        divided_.linear = !is_over() && divided_.error->error > share_of_division * whole_;
    }
    if (divided_.linear)
        divide_until_enough();
    if (!is_own_) {
        forget_run();
        divided_.error.reset();
    }
    if (divided_.run)
        divided_.rough = {}; // which has it
    const double seconds_run = divided_.run ? divided_.run->seconds : 0;
    work().seconds = watch.seconds() - seconds_run - work().seconds_error;
    return std::move(divided_);
}

} // namespace

Divided divide(Problem problem, const RunChoices& run, const DivisionChoices& choices,
               Monitor& monitor, Watcher& watcher) {
    std::optional<double> seconds;
    if (run.stop.seconds)
        seconds = share_of_time * *run.stop.seconds;
    const TimeLimit limit(monitor.interrupted, seconds);
    return AutoDivision(std::move(problem), run, choices, monitor, watcher).divide();
}

} // namespace hemilux
