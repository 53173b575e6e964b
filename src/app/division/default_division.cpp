#include "app/division/default_division.h"

#include "app/division/auto_division.h"
#include "app/division/whole_error.h"

#include <algorithm>

namespace hemilux {
namespace {

/// The bytes that stored transport takes for a patch, and the patch with its outputs.
constexpr std::uint64_t bytes_of_patch = 16'384;

bool writes_mesh(const SolveSettings& settings) {
    return std::ranges::any_of(settings.outputs, [&](const Output& output) {
        return output.kind == OutputKind::ply ||
               (output.kind == OutputKind::glb && !settings.file_bake.asked) ||
               output.kind == OutputKind::vtu;
    });
}

} // namespace

AdaptiveDivision division_of(const SolveSettings& settings, std::size_t patches) {
    AdaptiveDivision division{.error = share_of_division * whole_error(settings),
                              .seed = settings.options.seed,
                              .threads = settings.options.threads,
                              .keep_all = settings.options.keep_all};
    if (settings.stop.rays)
        division.max_rays = *settings.stop.rays;
    if (!settings.divide_given)
        division.max_patches = max_patches_by_default;
    if (settings.scene.memory) {
        division.memory = *settings.scene.memory / 2;
        division.max_patches =
            std::clamp<std::size_t>(*settings.scene.memory / bytes_of_patch, patches,
                                    std::max(patches, division.max_patches));
    }
    return division;
}

bool divides_by_default(const SolveSettings& settings, std::size_t patches) {
    return !settings.divide_given && patches < max_patches_by_default && writes_mesh(settings) &&
           settings.method == &method_of(Role::standard) && !settings.plain && !settings.useful &&
           settings.scene.mesh.max_edge == 0 && settings.target.names().empty() &&
           !settings.stop.steps && !settings.every_step && settings.reference.empty() &&
           settings.checkpoint.path.empty() && settings.checkpoint.resumed.empty();
}

StopRule stop_rule(const SolveSettings& settings, std::size_t patches,
                   std::optional<double> sampling) {
    StopRule stop = settings.stop;
    if (settings.divide_auto && (stop.error || (!stop.steps && !stop.seconds)))
        stop.error = sampling.value_or(share_of_sampling * whole_error(settings));
    else if (gives_gathered_light(settings) && settings.work().estimates_error &&
             (stop.error || (!stop.steps && !stop.seconds && !settings.useful)))
        stop.error = sampling_of_gathered(settings);
    if (!stop.steps && !stop.seconds && !stop.error && !settings.useful) {
        stop = settings.method->default_stop;
        stop.rays = settings.stop.rays;
        if (settings.work().ends_by_itself)
            stop.steps.reset();
        else if (!stop.steps && !stop.seconds && !stop.error)
            stop.steps = StopRule::default_steps;
    }
    if (!stop.steps && !stop.seconds && !stop.rays && settings.work().estimates_error) {
        stop.rays = default_max_rays(patches);
        stop.patience = default_patience;
    }
    return stop;
}

std::uint64_t default_max_rays(std::size_t patches) {
    constexpr std::uint64_t least = 100'000'000, each = 1000;
    return least + each * patches;
}

} // namespace hemilux
