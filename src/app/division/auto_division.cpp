#include "app/division/auto_division.h"

#include "app/division/default_division.h"
#include "app/division/whole_error.h"
#include "app/settings/text.h"
#include "app/terminal/log.h"
#include "app/terminal/stopwatch.h"
#include "parallel/workers.h"
#include "radiosity/engine/solving/time_limit.h"
#include "radiosity/light/division/adaptive_division.h"
#include "radiosity/light/light_error/division_error.h"
#include "radiosity/paper/sampling/rng.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hemilux {
namespace {

/// The share of the time of a run that the division may take.
constexpr double share_of_time = .5;

/// The error that sampling may leave on patches where light is gathered: at first, as gathers
/// average over them; and as a share of the whole error [-].
constexpr double first_sampling_of_gathered = .05, sampling_of_gathered = .4;

/// A goal is set lower by a factor in this range, with some room. Where light is gathered, finding
/// the error costs more than patches do, so steps are few and large.
constexpr double safe = .9, min_step = .5, max_step = .9, min_step_of_gathered = .3,
                 max_step_of_gathered = .6;

/// An error of gathered light, over that asked for, that need not be known better.
constexpr double negligible_when_reported = .05;

/// The number of times that the division goes on where the whole error is still too large.
constexpr unsigned max_attempts = 8;

/// Rays to find out the error of the division where patches were divided by rays. They are at most
/// one in so many of all before. But so many are always worth it, the more so where all light is
/// gathered and little else is traced.
constexpr std::uint64_t share_of_divided = 5, min_rays_of_error = 400'000,
                        min_rays_of_gathered = 4'000'000;

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
          is_gathered_(gives_gathered_light(settings)),
          is_own_(settings.method == &method_of(Role::standard) && !settings.plain),
          is_large_(is_large_by_default(settings, mesh.patches().size())) {}

    [[nodiscard]] Divided divide();

  private:
    /// Finds the light of the mesh as it is: by the run to come, where that is of the standard
    /// method.
    void run_to(double error, const StopRule& most);
    /// Measures how far the light that is given out is off by the division, at points of its own.
    void measure(DivisionErrorOptions options);
    [[nodiscard]] double measured() const {
        return is_gathered_ ? gathered_error(*divided_.spread, mesh_, divided_.rough).error
                            : divided_.error->error;
    }
    void begin_gathered();
    void lower_goals();
    void divide_once(Division& division);
    void divide_until_enough();
    /// Returns whether the whole error, as far as it is known, is as asked for. If it is not, less
    /// is left to what has the larger part.
    [[nodiscard]] bool is_enough(double sampling);
    void measure_at_first();
    void measure_again(DivisionErrorOptions options);
    [[nodiscard]] bool is_confirmed(std::uint64_t max_rays, double sampling,
                                    std::span<const double> square);
    [[nodiscard]] std::uint64_t rays_of_error(std::uint64_t before) const {
        return std::max(before / share_of_divided,
                        is_gathered_ ? min_rays_of_gathered : min_rays_of_error);
    }
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
    bool is_gathered_, is_own_, is_large_;
    std::uint64_t gathers_ = 0;
    double seconds_of_errors_ = 0;
    bool divides_ = true; ///< in the next attempt
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
    const DivisionError found =
        is_gathered_ ? spread_error(mesh_, input_.tracer, divided_.rough, gathers_near(settings_),
                                    options, workers, input_.monitor.interrupted)
                     : division_error(mesh_, input_.tracer, divided_.rough, options, workers,
                                      input_.monitor.interrupted);
    (is_gathered_ ? divided_.spread : divided_.error) = found;
    statistics_.rays_division_error += found.rays;
    seconds_of_errors_ += watch.seconds();
}

/// Begins the division for gathered light. Light on patches may vary as much as it does on those
/// that there are, but for what gathered light is to gain.
void AutoDivision::begin_gathered() {
    options_.error = division_error(mesh_, input_.tracer, divided_.rough,
                                    {.seed = hash_words({settings_.options.seed, 6})},
                                    Workers(settings_.options.threads), input_.monitor.interrupted)
                         .error;
    lower_goals();
}

/// Lowers the goal of patches, by less than gathered light is to gain: its error falls faster than
/// theirs.
void AutoDivision::lower_goals() {
    const double step = std::sqrt(safe * whole_ / measured()); // not a number where it is unknown
    options_.error *=
        step > min_step_of_gathered ? std::min(step, max_step_of_gathered) : min_step_of_gathered;
    divided_.sampling = sampling_of_gathered * whole_;
}

/// Returns whether it is enough. What is left is aimed at with some room, as what was found is
/// known to a tenth.
bool AutoDivision::is_enough(double sampling) {
    constexpr double min_sampling = .6;
    if (is_gathered_) {
        if (measured() <= whole_)
            return true;
        lower_goals();
        return false;
    }
    const double division = measured();
    if (std::hypot(division, sampling) <= whole_)
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

/// Confirms an error, as the first of several errors to be small enough errs low.
bool AutoDivision::is_confirmed(std::uint64_t max_rays, double sampling,
                                std::span<const double> square) {
    const DivisionErrorOptions options{
        .max_rays = max_rays,
        .negligible = is_gathered_ ? resolved_gathered_error(settings_) : sampling / 2,
        .square = square};
    measure(options);
    if (is_over() || !is_enough(sampling))
        return false;
    measure_again(options);
    return !is_over() && is_enough(sampling);
}

/// Measures at other points, and with more rays, as it is reported. The error of gathered light is
/// found out better even where it is negligible.
void AutoDivision::measure_again(DivisionErrorOptions options) {
    constexpr unsigned more_rays = 4;
    options.max_rays *= more_rays;
    if (is_gathered_)
        options.negligible = negligible_when_reported * whole_;
    measure(options);
}

/// Measures for the first time. The error of gathered light is found out as it is reported: mostly
/// nothing is divided.
void AutoDivision::measure_at_first() {
    const DivisionErrorOptions options{
        .max_rays = rays_of_error(0),
        .negligible = (is_gathered_ ? negligible_when_reported : share_of_division) * whole_};
    measure(options);
    if (!is_gathered_ || is_over() || !(divided_.spread->error <= safe * whole_))
        return;
    const DivisionError& found = *divided_.spread;
    if (!found.is_known(options.negligible) || found.error + 2 * found.uncertainty > safe * whole_)
        measure_again(options);
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

void AutoDivision::divide_until_enough() {
    Division division(mesh_, input_.tracer, options_, input_.monitor);
    const std::uint64_t max_rays =
        settings_.stop.rays.value_or(default_max_rays(mesh_.patches().size()));
    for (unsigned attempt = 0; attempt < max_attempts; ++attempt) {
        if (divides_)
            divide_once(division);
        if (is_over())
            break;
        StopRule stop;
        stop.rays = max_rays;
        run_to(*divided_.sampling, stop);
        if (is_over())
            break;
        statistics_.rays_divide += division.add_slopes(divided_.rough, options_.error);
        const double sampling = estimated_error(mesh_, divided_.rough);
        const std::uint64_t rays = divided_.rough.rays_energy + statistics_.rays_divide;
        const bool is_aimed_at = sampling <= *divided_.sampling; // else by rays or steps
        const bool done =
            is_confirmed(rays_of_error(rays), sampling, division.squares()) || !is_aimed_at;
        if (is_over() || done || rays + statistics_.rays_division_error > max_rays)
            break;
        division.doubt();
    }
    divided_.slope = division.slopes();
}

Divided AutoDivision::divide() {
    const Stopwatch watch;
    StopRule rough = rough_stop(options_, mesh_.patches().size());
    divided_.sampling = share_of_sampling * whole_;
    if (is_gathered_)
        divided_.sampling = rough.error =
            std::max(first_sampling_of_gathered, sampling_of_gathered * whole_);
    run_to(*rough.error, rough);
    if (!is_over())
        measure_at_first();
    if (!is_over() && is_gathered_) {
        const double spread = divided_.spread->error;
        divided_.linear = spread > safe * whole_;
        // Less than half of what is off is not worth its rays, where it is not divided.
        const bool stays = divided_.linear && (mesh_.patches().size() >= options_.max_patches ||
                                               (is_large_ && spread <= error_of_large_models));
        divided_.sampling = std::max(sampling_of_gathered * whole_, stays ? .5 * spread : 0);
        divided_.linear = divided_.linear && !stays;
        if (divided_.linear && is_large_)
            whole_ = std::max(whole_, error_of_large_models);
    } else if (!is_over()) {
        divided_.linear = divided_.error->error > share_of_division * whole_;
    }
    if (is_gathered_ && divided_.linear)
        begin_gathered();
    if (divided_.linear)
        divide_until_enough();
    if (!is_own_) {
        forget_run();
        divided_.error.reset();
        divided_.spread.reset();
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
