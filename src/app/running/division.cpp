#include "app/running/division.h"

#include "app/settings/text.h"
#include "app/terminal/log.h"
#include "app/terminal/stopwatch.h"
#include "radiosity/division/adaptive_division.h"
#include "radiosity/final_gather/division_error.h"
#include "radiosity/final_gather/light_within_patches.h"
#include "radiosity/sampling/rng.h"
#include "radiosity/sampling/workers.h"
#include "radiosity/solving/time_limit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace hemilux {
namespace {

/// What stored transport takes, and the patch with its outputs.
constexpr std::uint64_t bytes_of_patch = 16'384;

/// Of the time of a run that the division may take.
constexpr double share_of_time = .5;

/// The noise of slopes is to be a small part of the error.
std::size_t estimates_of_slopes(double error) {
    constexpr double one_is_enough_at = .04, most = 8;
    return static_cast<std::size_t>(
        std::clamp(std::round(std::pow(one_is_enough_at / error, 1.5)), 1.0, most));
}

std::string round_text(const DivisionRound& round) {
    return "division: " + counted(round.patches, "patch", "patches") + ", within them the light " +
           "differs by about " + percent(round.error);
}

AdaptiveDivision division_of(const SolveSettings& settings, std::size_t patches) {
    AdaptiveDivision division{.error = division_share * whole_error(settings),
                              .seed = settings.options.seed,
                              .threads = settings.options.threads};
    if (settings.scene.memory) {
        division.memory = *settings.scene.memory / 2;
        division.most_patches =
            std::max<std::size_t>(patches, *settings.scene.memory / bytes_of_patch);
    }
    return division;
}

/// Whether one value on each patch leaves more than the share of the division: asked of a thousand
/// points, however many patches there are.
bool is_uneven(const SolveSettings& settings, const Mesh& mesh, const Tracer& tracer,
               const Solution& solution, Monitor& monitor, Statistics& statistics) {
    if (solution.steps == 0 || monitor.interrupted)
        return false;
    const double most = division_share * whole_error(settings);
    const DivisionError found = division_error(
        mesh, tracer, solution,
        {.seed = hash_words({settings.options.seed, 4}), .most_rays = 0, .negligible = most},
        Workers(settings.options.threads), monitor.interrupted);
    statistics.rays_divide += found.rays;
    return found.error > most;
}

} // namespace

double whole_error(const SolveSettings& settings) {
    constexpr double usual = .05;
    return settings.stop.error.value_or(usual);
}

Divided divide_as_asked(const SolveSettings& settings, Mesh& mesh, const SolverInput& input,
                        const BeginSolver& begin, Statistics& statistics) {
    Divided divided;
    if (!settings.divide_auto)
        return divided;
    const Stopwatch watch;
    Monitor& monitor = input.monitor;
    std::optional<double> seconds;
    if (settings.stop.seconds)
        seconds = share_of_time * *settings.stop.seconds;
    const TimeLimit limit(monitor.interrupted, seconds);
    const AdaptiveDivision division = division_of(settings, mesh.patches().size());
    if (settings.method == &method_of(Role::standard) && !settings.plain) {
        divided.begun = begin();
        StopRule rough = rough_stop(division, mesh.patches().size());
        rough.steps = settings.stop.steps;
        run(*divided.begun, input, rough, [&](const StepRecord& record, const Solution&) {
            divided.before = {record.step, record.seconds};
        });
        divided.rough = divided.begun->solution();
    } else {
        divided.rough = rough_solution(mesh, input.tracer, division, monitor);
        statistics.rays_divide = divided.rough.rays_energy;
    }
    divided.linear = is_uneven(settings, mesh, input.tracer, divided.rough, monitor, statistics);
    if (divided.linear)
        divided.patches = divide_where_light_changes(
            mesh, input.tracer, divided.rough, division, monitor, [&](const DivisionRound& round) {
                statistics.rays_divide += round.rays;
                log_line(settings.verbosity, Verbosity::verbose, round_text(round));
            });
    else if (divided.begun) // which has it
        divided.rough = {};
    if (divided.patches && divided.begun)
        statistics.rays_divide += divided.begun->solution().rays_energy;
    if (divided.patches) {
        divided.begun.reset();
        divided.before = {};
    }
    statistics.seconds_divide = watch.seconds() - divided.before.seconds;
    return divided;
}

void add_slopes(const SolveSettings& settings, const Mesh& mesh, const Tracer& tracer,
                Solution& solution, const StopFlag& interrupted, Statistics& statistics) {
    if (solution.steps == 0 || interrupted)
        return;
    std::vector<std::uint32_t> all(mesh.patches().size());
    std::iota(all.begin(), all.end(), 0u);
    const LightWithinPatches found =
        light_within_patches({mesh, tracer, solution}, all,
                             {.estimates = estimates_of_slopes(whole_error(settings)),
                              .most_rows = 3,
                              .seed = hash_words({settings.options.seed, 3})},
                             Workers(settings.options.threads), interrupted);
    if (interrupted)
        return;
    solution.slope = found.slope;
    statistics.rays_divide += found.rays;
}

void add_division_error(Statistics& statistics, const SolveSettings& settings, const Mesh& mesh,
                        const Tracer& tracer, const Solution& solution,
                        const StopFlag& interrupted) {
    statistics.error_sampling = statistics.estimated_error;
    if (solution.steps == 0 || interrupted) {
        if (settings.divide_auto) // the whole error is not known
            statistics.estimated_error = statistics.estimated_error_uncertainty =
                std::numeric_limits<double>::quiet_NaN();
        return;
    }
    constexpr std::uint64_t share_of_rays = 2; // of all before, at most: one in so many
    const Stopwatch watch;
    const DivisionError found = division_error(
        mesh, tracer, solution,
        {.seed = hash_words({settings.options.seed, 1}),
         .most_rays = (solution.rays_energy + solution.rays_density + statistics.rays_divide) /
                      share_of_rays,
         .negligible = statistics.error_sampling / 2},
        Workers(settings.options.threads), interrupted);
    statistics.error_division = found.error;
    statistics.error_division_uncertainty = found.uncertainty;
    statistics.rays_division_error = found.rays;
    statistics.seconds_division_error = watch.seconds();
    if (!settings.divide_auto)
        return;
    const double whole = std::hypot(statistics.error_sampling, found.error);
    statistics.estimated_error_uncertainty =
        std::hypot(statistics.error_sampling * statistics.estimated_error_uncertainty,
                   found.error * found.uncertainty) /
        whole;
    statistics.estimated_error = whole;
}

} // namespace hemilux
