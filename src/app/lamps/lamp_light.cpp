#include "app/lamps/lamp_light.h"

#include "app/settings/exit_code.h"
#include "app/settings/names.h"
#include "app/terminal/log.h"
#include "app/terminal/stage.h"
#include "io/files/error.h"
#include "parallel/stopwatch.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace hemilux {
namespace {

constexpr std::size_t max_layers = 64;

std::string errors_text(const std::vector<LayerFigures>& layers) {
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (const LayerFigures& layer : layers)
        if (std::isfinite(layer.error)) {
            least = std::min(least, layer.error);
            most = std::max(most, layer.error);
        }
    std::string text = counted(layers.size(), "layer", "layers") + " of light, by " +
                       (layers.size() > 1 ? "lamps apart" : "its lamp");
    if (most > 0)
        text += "; the error of each by itself is " +
                (least == most ? percent(most) : percent(least) + " to " + percent(most));
    return text;
}

} // namespace

void check_layers(const SolveSettings& settings) {
    if (!settings.layers)
        return;
    if (settings.method != &method_of(Role::standard) || settings.plain)
        throw UsageError("--layers: only --method " + std::string(method_of(Role::standard).name) +
                         " keeps the rays that other lamps would take, and not with --plain");
}

void check_layers(const SolveSettings& settings, const Mesh& mesh, const LayerSize& size,
                  MemoryNeed& need) {
    if (!settings.layers)
        return;
    const std::size_t layers = find_lamp_layers(mesh, *settings.layers).layers.size();
    if (layers == 0)
        throw InputError(settings.scene.path, "nothing emits light; --layers has nothing to show");
    if (layers > max_layers)
        throw UsageError("--layers: " + grouped(layers) + " are more than " + grouped(max_layers) +
                         "; --layers material and --layers group join lamps");
    need.results += bytes_of_layers(settings, need, size, layers);
    check_memory(need, settings.scene.memory, settings.scene.path,
                 "--layers material and --layers group join lamps");
}

LampLight find_lamp_light(const SolveSettings& settings, const LitRun& run, Monitor& monitor,
                          Statistics& statistics) {
    if (!settings.layers)
        return {};
    const Stage stage("lighting by each lamp", settings.verbosity);
    const Stopwatch watch;
    const auto* const solver = dynamic_cast<const KeepsRays*>(&run.solver);
    std::optional<LampLight> light;
    if (solver && run.solver.solution().steps > 0 && !monitor.interrupted)
        light = light_of_lamps(run.scene, run.solution, *solver, *settings.layers, monitor);
    WantedLight wanted = run.wanted;
    if (std::ranges::find(settings.outputs, OutputKind::exr, &Output::kind) ==
        settings.outputs.end())
        wanted.picture.reset(); // others have no layers
    else if (wanted.picture)
        wanted.picture->rows_done = {};
    Asked asked = run.asked;
    asked.accuracy = 0;
    if (!light ||
        (run.gathered.was_wanted &&
         !gather_lamps(*light, run.scene, run.solution, run.gathered, wanted, asked, monitor))) {
        log_line(settings.verbosity, Verbosity::quiet,
                 "interrupted; the outputs hold the light of all lamps together");
        return {};
    }
    for (std::size_t k = 0; k < light->patches.size(); ++k)
        statistics.layers.push_back(
            {light->lamps.layers[k].name, light->lamps.layers[k].power, light->errors[k]});
    statistics.rays_layers = light->rays;
    statistics.seconds_layers = watch.seconds();
    log_line(settings.verbosity, Verbosity::normal, errors_text(statistics.layers));
    return std::move(*light);
}

std::vector<std::string> channel_names(const LampLayers& lamps) {
    constexpr std::size_t most = 31 - 2; // a dot and a letter follow
    std::set<std::string> taken;
    std::vector<std::string> names;
    for (const LampLayer& layer : lamps.layers) {
        std::string name = layer.name.substr(0, most);
        for (unsigned number = 2; !taken.insert(name).second; ++number) {
            const std::string end = " " + std::to_string(number);
            name = layer.name.substr(0, most - end.size()) + end;
        }
        names.push_back(std::move(name));
    }
    return names;
}

} // namespace hemilux
