#include "app/division/whole_error.h"

#include "geometry/elementary.h"
#include "parallel/stopwatch.h"
#include "parallel/workers.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/light/light_error/division_error.h"
#include "radiosity/paper/sampling/rng.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace hemilux {
namespace {

/// Rays to find out the error of the division: at most one in so many of all before.
constexpr std::uint64_t share_of_rays = 2;

/// The relative error of the division below which errors are not resolved where nothing asks for it
/// [-].
constexpr double resolved_on_fixed_patches = .01;

/// Enters the errors into the statistics. With --divide auto the estimated error is that of the
/// light as given out: both errors of patches together.
void enter(Statistics& statistics, const DivisionError& of_patches, bool divide_auto) {
    statistics.error_division = of_patches.error;
    statistics.error_division_uncertainty = of_patches.uncertainty;
    if (divide_auto) {
        const double whole = elementary::hypot(statistics.error_sampling, of_patches.error);
        statistics.estimated_error_uncertainty =
            elementary::hypot(statistics.error_sampling * statistics.estimated_error_uncertainty,
                              of_patches.error * of_patches.uncertainty) /
            whole;
        statistics.estimated_error = whole;
    }
}

} // namespace

double error_of_gathered(const SolveSettings& settings) {
    constexpr double usual = .02, usual_of_bake = .05;
    return settings.stop.error.value_or(settings.file_bake.asked ? usual_of_bake : usual);
}

double whole_error(const SolveSettings& settings) {
    constexpr double usual = .05;
    return gives_gathered_light(settings) ? error_of_gathered(settings)
                                          : settings.stop.error.value_or(usual);
}

double sampling_of_gathered(const SolveSettings& settings) {
    constexpr double most = .05;
    return std::max(most, whole_error(settings));
}

bool gives_gathered_light(const SolveSettings& settings) {
    const bool is_of_patches =
        !settings.error_map.empty() || !settings.report.empty() ||
        !std::ranges::all_of(settings.outputs, [&](const Output& output) {
            if (is_own_file(output.kind) && settings.file_bake.asked)
                return true;
            return is_picture(output.kind) && output.kind != OutputKind::exr; // layers of patches
        });
    const bool pictures = !settings.outputs.empty() && settings.gather_pictures;
    return !is_of_patches && (settings.outputs.empty() || pictures) &&
           (pictures || !settings.points.path.empty());
}

void add_division_error(Statistics& statistics, const SolveSettings& settings, const Mesh& mesh,
                        const Tracer& tracer, const Solution& solution, const Divided& divided,
                        const StopFlag& interrupted) {
    statistics.error_sampling = statistics.estimated_error;
    if (!solution.weight.empty() && !settings.divide_auto) // rays are for the target's own patches
        return;
    if (!settings.divide_auto && !settings.whole_error)
        return;
    std::optional<DivisionError> of_patches;
    if (solution.steps == divided.steps.size())
        of_patches = divided.error;
    if (settings.divide_auto && solution.weight.empty())
        statistics.estimated_error_of = ErrorOf::surfaces;
    if (!of_patches && (solution.steps == 0 || interrupted)) {
        if (settings.divide_auto) // the whole error is not known
            statistics.estimated_error = statistics.estimated_error_uncertainty =
                std::numeric_limits<double>::quiet_NaN();
        return;
    }
    const Stopwatch watch;
    const Workers workers(settings.options.threads);
    DivisionErrorOptions options{
        .max_rays = (solution.rays_energy + solution.rays_density + statistics.rays_divide) /
                    share_of_rays};
    if (!of_patches) {
        options.seed = hash_words({settings.options.seed, 1});
        options.negligible = settings.divide_auto ? 0 : resolved_on_fixed_patches;
        if (statistics.error_sampling > 2 * options.negligible) // unknown after one step
            options.negligible = statistics.error_sampling / 2;
        of_patches = division_error(mesh, tracer, solution, options, workers, interrupted);
        statistics.rays_division_error += of_patches->rays;
        const double before = statistics.seconds_division_error;
        statistics.seconds_division_error = (before > 0 ? before : 0) + watch.seconds();
    }
    enter(statistics, *of_patches, settings.divide_auto);
}

std::string whole_error_note(const SolveSettings& settings, const Statistics& statistics) {
    const bool is_asked = settings.stop.error || (!settings.stop.steps && !settings.stop.seconds);
    const double asked = whole_error(settings);
    if (!is_asked)
        return "";
    if (statistics.estimated_error_of == ErrorOf::gathered)
        return statistics.error_bound <= asked || std::isnan(statistics.estimated_error)
                   ? ""
                   : "the run ended before the error of gathered light was surely below " +
                         percent(asked) + ", for which more rays are needed (--max-rays, --time)";
    if (!settings.divide_auto || statistics.estimated_error <= asked ||
        !std::isfinite(statistics.error_division))
        return "";
    const std::string options = settings.divide_given ? "--memory, --time" : "--divide auto";
    const bool of_division = statistics.error_division > statistics.error_sampling;
    return "the run ended before the whole error of " + percent(asked) +
           " was reached; most of what is left is of " +
           (of_division ? "the division, which more patches (" + options + ") make less"
                        : "sampling, which more rays (--max-rays, --time) make less");
}

} // namespace hemilux
