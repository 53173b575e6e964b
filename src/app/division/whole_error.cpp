#include "app/division/whole_error.h"

#include "app/settings/outputs.h"
#include "radiosity/answers/asked/text.h"

#include <algorithm>
#include <cmath>

namespace hemilux {
namespace {

bool writes_mesh(const SolveSettings& settings) {
    return std::ranges::any_of(settings.outputs, [&](const Output& output) {
        return output.kind == OutputKind::ply ||
               (output.kind == OutputKind::glb && !settings.file_bake.asked) ||
               output.kind == OutputKind::vtu;
    });
}

/// Returns the error of sampling that patches may have where all light is gathered from them:
/// gathers average over patches, and learn what these lack.
double sampling_of_gathered(const SolveSettings& settings) {
    constexpr double most = .05;
    return std::max(most, whole_error(settings));
}

/// Returns RunChoices::sampling.
std::optional<double> sampling_of(const SolveSettings& settings) {
    if (settings.divide_auto)
        return share_of_sampling * whole_error(settings);
    if (gives_gathered_light(settings) && settings.work().estimates_error &&
        (settings.stop.error || !settings.useful))
        return sampling_of_gathered(settings);
    return {};
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

bool divides_by_default(const SolveSettings& settings, std::size_t patches) {
    return !settings.divide_given && patches < max_patches_by_default && writes_mesh(settings) &&
           settings.method == &method_of(Role::standard) && !settings.plain && !settings.useful &&
           settings.scene.mesh.max_edge == 0 && settings.target.names().empty() &&
           !settings.stop.steps && !settings.every_step && settings.reference.empty() &&
           settings.checkpoint.path.empty() && settings.checkpoint.resumed.empty();
}

DivisionChoices division_choices(const SolveSettings& settings) {
    DivisionChoices choices{.error = whole_error(settings), .standard = &method_of(Role::standard)};
    if (!settings.divide_given)
        choices.max_patches = max_patches_by_default;
    return choices;
}

RunChoices run_choices(const SolveSettings& settings, double bytes_needed) {
    return {.method = settings.method,
            .plain = settings.plain,
            .options = settings.options,
            .stop = settings.stop,
            .sampling = sampling_of(settings),
            .until_useful = settings.useful,
            .memory = {.limit = settings.scene.memory, .needed = bytes_needed}};
}

bool finds_whole_error(const SolveSettings& settings, const Solution& solution) {
    return settings.divide_auto || (settings.whole_error && solution.weight.empty());
}

std::optional<Finding> whole_error_note(const SolveSettings& settings,
                                        const Statistics& statistics) {
    const bool is_asked = settings.stop.error || (!settings.stop.steps && !settings.stop.seconds);
    const double asked = whole_error(settings);
    if (!is_asked)
        return {};
    if (statistics.estimated_error_of == ErrorOf::gathered) {
        if (statistics.error_bound <= asked || std::isnan(statistics.estimated_error))
            return {};
        return Finding{Finding::Kind::warning,
                       "the run ended before the error of gathered light was surely below " +
                           percent(asked) +
                           ", for which more rays are needed (--max-rays, --time)"};
    }
    if (!settings.divide_auto || statistics.estimated_error <= asked)
        return {};
    return whole_error_finding(asked,
                               {.sampling = statistics.error_sampling,
                                .sampling_uncertainty = 0,
                                .division = {.error = statistics.error_division}},
                               settings.divide_given ? "--memory, --time" : "--divide auto");
}

} // namespace hemilux
