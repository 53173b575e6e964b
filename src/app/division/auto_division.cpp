#include "app/division/auto_division.h"

#include "app/division/default_division.h"
#include "app/division/whole_error.h"
#include "app/terminal/log.h"
#include "geometry/elementary.h"
#include "parallel/stopwatch.h"
#include "parallel/workers.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/engine/solving/time_limit.h"
#include "radiosity/light/division/adaptive_division.h"
#include "radiosity/light/light_error/division_error.h"
#include "radiosity/paper/sampling/rng.h"

#include <algorithm>
#include <cmath>
#include <limits>
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

std::string round_text(const DivisionRound& round) {
    return "division: " + counted(round.patches, "patch", "patches") + ", within them the light " +
           "differs by about " + percent(round.error);
}

/// Divides the mesh for a run to come.
class AutoDivision {
  public:
    AutoDivision(const SolveSettings& settings, Mesh& mesh, const SolverInput& input,
                 const BeginSolver& begin, const MeshChanged& mesh_changed, Statistics& statistics)
        : settings_(settings), mesh_(mesh), input_(input), begin_(begin),
          mesh_changed_(mesh_changed), statistics_(statistics),
          options_(division_of(settings, mesh.patches().size())), whole_(whole_error(settings)),
          is_own_(settings.method == &method_of(Role::standard) && !settings.plain) {}

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
    [[nodiscard]] bool is_over() const {
        return input_.monitor.interrupted || divided_.rough.steps == 0;
    }
    void forget_run();

    const SolveSettings& settings_;
    Mesh& mesh_;
    const SolverInput& input_;
    const BeginSolver& begin_;
    const MeshChanged& mesh_changed_;
    Statistics& statistics_;
    AdaptiveDivision options_;
    double whole_;
    bool is_own_;
    std::uint64_t gathers_ = 0;
    double seconds_of_errors_ = 0;
    bool divides_ = true;    ///< in the next attempt
    unsigned divisions_ = 0; ///< attempts that divided
    Divided divided_;
};

void AutoDivision::run_to(double error, const StopRule& most) {
    if (!divided_.begun) {
        divided_.begun = is_own_ ? begin_() : method_of(Role::standard).make(input_);
        divided_.steps.clear();
    }
    StopRule stop = most;
    stop.error = error;
    if (is_own_)
        stop.steps = settings_.stop.steps;
    run(
        *divided_.begun, input_, stop,
        [&](const StepRecord& record, const Solution&) { divided_.steps.push_back(record); },
        divided_.before());
    divided_.rough = divided_.begun->solution();
}

void AutoDivision::forget_run() {
    if (divided_.begun)
        statistics_.rays_divide += divided_.begun->solution().rays_energy;
    divided_.begun.reset();
    divided_.steps.clear();
}

void AutoDivision::measure(DivisionErrorOptions options) {
    options.seed = hash_words({settings_.options.seed, 4, gathers_++});
    const Stopwatch watch;
    const Workers workers(settings_.options.threads);
    const DivisionError found = division_error(mesh_, input_.tracer, divided_.rough, options,
                                               workers, input_.monitor.interrupted);
    divided_.error = found;
    statistics_.rays_division_error += found.rays;
    seconds_of_errors_ += watch.seconds();
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
    const std::uint64_t before = divided_.rough.rays_energy + statistics_.rays_divide;
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
            statistics_.rays_divide += round.rays;
            log_line(settings_.verbosity, Verbosity::verbose, round_text(round));
        }))
        return;
    divided_.patches = true;
    forget_run(); // which refers to what changes
    mesh_changed_();
}

/// Where rays are limited, the division may take half of them.
void AutoDivision::divide_until_enough() {
    const std::uint64_t max_rays =
        settings_.stop.rays.value_or(default_max_rays(mesh_.patches().size()));
    const auto spent = [&] { return statistics_.rays_divide + statistics_.rays_division_error; };
    if (settings_.stop.rays)
        options_.max_rays =
            max_rays / 2 - std::min(spent() + divided_.rough.rays_energy, max_rays / 2);
    Division division(mesh_, input_.tracer, options_, input_.monitor);
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
        statistics_.rays_divide += division.add_slopes(divided_.rough, options_.error);
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
    if (divided_.begun)
        divided_.rough = {}; // which has it
    statistics_.seconds_division_error = seconds_of_errors_;
    statistics_.seconds_divide = watch.seconds() - divided_.before().seconds - seconds_of_errors_;
    return std::move(divided_);
}

} // namespace

Divided divide_as_asked(const SolveSettings& settings, Mesh& mesh, const SolverInput& input,
                        const BeginSolver& begin, const MeshChanged& mesh_changed,
                        Statistics& statistics) {
    if (!settings.divide_auto)
        return {};
    std::optional<double> seconds;
    if (settings.stop.seconds)
        seconds = share_of_time * *settings.stop.seconds;
    const TimeLimit limit(input.monitor.interrupted, seconds);
    return AutoDivision(settings, mesh, input, begin, mesh_changed, statistics).divide();
}

} // namespace hemilux
