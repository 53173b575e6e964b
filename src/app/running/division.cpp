#include "app/running/division.h"

#include "app/settings/text.h"
#include "app/terminal/log.h"
#include "app/terminal/stopwatch.h"
#include "radiosity/division/adaptive_division.h"
#include "radiosity/final_gather/division_error.h"
#include "radiosity/sampling/rng.h"
#include "radiosity/sampling/workers.h"

#include <algorithm>
#include <cmath>

namespace hemilux {
namespace {

/// What stored transport takes, and the patch with its outputs.
constexpr std::uint64_t bytes_of_patch = 16'384;

/// Of the time of a run that the division may take before its last round, which may take four
/// times as long.
constexpr double share_of_time = 1.0 / 8;

std::string round_text(const DivisionRound& round) {
    return "division: " + counted(round.patches, "patch", "patches") + ", within them the light " +
           "differs by " + percent(round.found.error) + ", give or take " +
           percent(round.found.uncertainty);
}

} // namespace

double whole_error(const SolveSettings& settings) {
    constexpr double usual = .05;
    return settings.stop.error.value_or(usual);
}

bool divide_as_asked(const SolveSettings& settings, Mesh& mesh, const Tracer& tracer,
                     Monitor& monitor, Statistics& statistics) {
    if (!settings.divide_auto)
        return false;
    const Stopwatch watch;
    const std::size_t before = mesh.patches().size();
    AdaptiveDivision division{.error = division_share * whole_error(settings),
                              .seed = settings.options.seed,
                              .threads = settings.options.threads};
    if (settings.scene.memory) {
        division.memory = *settings.scene.memory / 2;
        division.most_patches =
            std::max<std::size_t>(before, *settings.scene.memory / bytes_of_patch);
    }
    if (settings.stop.seconds)
        division.seconds = share_of_time * *settings.stop.seconds;
    divide_where_light_changes(mesh, tracer, division, monitor, [&](const DivisionRound& round) {
        statistics.rays_divide += round.rays;
        log_line(settings.verbosity, Verbosity::verbose, round_text(round));
    });
    statistics.seconds_divide = watch.seconds();
    return mesh.patches().size() != before;
}

void add_division_error(Statistics& statistics, const SolveSettings& settings, const Mesh& mesh,
                        const Tracer& tracer, const Solution& solution,
                        const StopFlag& interrupted) {
    statistics.error_sampling = statistics.estimated_error;
    if (solution.steps == 0 || interrupted)
        return;
    constexpr std::uint64_t share_of_rays = 2; // of those of the solution, at most: one in so many
    const Stopwatch watch;
    const DivisionError found =
        division_error(mesh, tracer, solution,
                       {.seed = hash_words({settings.options.seed, 1}),
                        .most_rays = (solution.rays_energy + solution.rays_density) / share_of_rays,
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
