#include "app/lamps/lamp_light.h"

#include "app/division/whole_error.h"
#include "app/settings/exit_code.h"
#include "app/settings/names.h"
#include "app/terminal/log.h"
#include "app/terminal/stage.h"
#include "io/files/error.h"
#include "parallel/ranks.h"
#include "parallel/stopwatch.h"
#include "parallel/workers.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/engine/solving/shared_stop.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <utility>

namespace hemilux {
namespace {

constexpr std::size_t max_layers = 64;

/// A layer is gathered to this relative error of its own at the most, however faint it is. All of
/// them together are as exact as the whole was asked to be.
constexpr double max_layer_error = .1;

/// Returns the error of a layer on patches, relative to the light that it reflects; NaN where that
/// is none.
double error_on_patches(const Mesh& mesh, const LampPatches& light, std::size_t layer) {
    const Relit& part = light.patches[layer];
    double reflected = 0, errors = 0;
    for (std::uint32_t i = 0; i < part.radiosity.size(); ++i) {
        const Vec3 own = part.radiosity[i] - emission_in(mesh, light.lamps, layer, i);
        const Vec3& error = part.standard_error[i];
        reflected += mesh.patches()[i].area * glm::dot(own, own);
        errors += mesh.patches()[i].area * glm::dot(error, error);
    }
    return reflected > 0 ? std::sqrt(errors / reflected) : Statistics::unknown;
}

void add_up(const LampShares& shares, const LightAtPoints& whole,
            std::vector<std::vector<PointLight>>& parts) {
    const std::size_t points = whole.lights.size();
    for (std::vector<PointLight>& part : parts)
        part.resize(points);
    for (std::size_t point = 0; point < points; ++point)
        shares.add_up(whole.lights[point].irradiance,
                      [&](std::size_t k) -> Vec3& { return parts[k][point].irradiance; });
}

class Layers {
  public:
    Layers(const SolveSettings& settings, const LitRun& run, Monitor& monitor,
           Statistics& statistics)
        : settings_(settings), run_(run), monitor_(monitor), statistics_(statistics),
          workers_(settings.options.threads) {
        found_.lamps = find_lamp_layers(run.scene.mesh, *settings.layers);
        for (const LampLayer& layer : found_.lamps.layers)
            all_power_ += mean_of_channels(layer.power);
    }

    /// Returns whether it came to the end before a signal.
    [[nodiscard]] bool find_patches(const KeepsRays& solver);
    [[nodiscard]] bool gather();
    [[nodiscard]] LampLight result() { return std::move(found_); }

  private:
    const SolveSettings& settings_;
    const LitRun& run_;
    Monitor& monitor_;
    Statistics& statistics_;
    Workers workers_;
    LampLight found_;
    double all_power_ = 0;
};

bool Layers::find_patches(const KeepsRays& solver) {
    const Mesh& mesh = run_.scene.mesh;
    const std::unique_ptr<Relighting> rays = solver.relighting(workers_);
    for (std::uint32_t k = 0; k < found_.lamps.layers.size(); ++k) {
        const LampLayer& layer = found_.lamps.layers[k];
        const std::uint64_t before = monitor_.rays;
        std::optional<Relit> light =
            rays->light_of(lit_by_layer(mesh, found_.lamps, k),
                           mean_of_channels(layer.power) / all_power_, workers_);
        if (!light)
            return false;
        statistics_.rays_layers += monitor_.rays - before;
        found_.patches.push_back(std::move(*light));
    }
    share_whole(mesh, run_.solution, found_);
    for (std::size_t k = 0; k < found_.patches.size(); ++k) {
        const LampLayer& layer = found_.lamps.layers[k];
        statistics_.layers.push_back({layer.name, layer.power, error_on_patches(mesh, found_, k)});
    }
    return true;
}

bool Layers::gather() {
    const auto& [scene, solver, solution, gathered, points, camera, lightmaps] = run_;
    if (!gathered.cache)
        return true;
    found_.lightmaps.resize(gathered.lightmaps.size());
    const auto keep = [&](std::vector<PointLight> lights, std::optional<Image> picture,
                          std::vector<Image> maps) {
        found_.points.push_back(std::move(lights));
        if (picture)
            found_.pictures.push_back(std::move(*picture));
        for (std::size_t map = 0; map < maps.size(); ++map)
            found_.lightmaps[map].push_back(std::move(maps[map]));
    };
    if (found_.patches.size() == 1) {
        keep(gathered.points.lights, gathered.picture, gathered.lightmaps);
        statistics_.layers[0].error = gathered.error;
        return true;
    }
    SolveSettings settings = settings_;
    settings.verbosity = Verbosity::quiet;
    settings.error_accuracy = 0;
    std::erase_if(settings.outputs, [](const Output& output) { // they have no layers
        return is_picture(output.kind) && output.kind != OutputKind::exr;
    });
    if (!gathers(settings))
        return true;
    const WholeLight whole{gathered.levels,
                           error_of_gathered(settings) / std::sqrt(double(found_.patches.size())),
                           max_layer_error};
    for (std::uint32_t k = 0; k < found_.patches.size(); ++k) {
        const Mesh lit = lit_by_layer(scene.mesh, found_.lamps, k);
        const Solution own = solution_of(solution, found_.patches[k]);
        Statistics statistics;
        GatheredLight light =
            gather_light(settings, {lit, scene.tracer, own.radiosity, scene.threads}, own, points,
                         camera, lightmaps, monitor_, statistics, whole);
        if (monitor_.interrupted)
            return false;
        statistics_.rays_layers += statistics.rays_learn + statistics.rays_gather;
        statistics_.layers[k].error = light.error;
        keep(std::move(light.points.lights), std::move(light.picture), std::move(light.lightmaps));
    }
    const LampShares shares(found_.lamps);
    add_up(shares, gathered.points, found_.points);
    if (!found_.pictures.empty())
        add_up(shares, *gathered.picture, found_.pictures);
    for (std::size_t map = 0; map < found_.lightmaps.size(); ++map)
        add_up(shares, gathered.lightmaps[map], found_.lightmaps[map]);
    return true;
}

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
    Layers layers(settings, run, monitor, statistics);
    if (!solver || run.solver.solution().steps == 0 || monitor.interrupted ||
        !layers.find_patches(*solver) || (settings.ranks->is_first() && !layers.gather())) {
        statistics.layers.clear();
        log_line(settings.verbosity, Verbosity::quiet,
                 "interrupted; the outputs hold the light of all lamps together");
        return {};
    }
    statistics.seconds_layers = watch.seconds();
    log_line(settings.verbosity, Verbosity::normal, errors_text(statistics.layers));
    return layers.result();
}

Solution solution_of(const Solution& whole, const Relit& layer) {
    Solution own = whole;
    own.radiosity = layer.radiosity;
    own.standard_error = layer.standard_error;
    own.slope = layer.slope;
    own.variance.reset();
    return own;
}

void add_up(const LampShares& shares, const Image& whole, std::span<Image> parts) {
    for (std::size_t pixel = 0; pixel < whole.pixels.size(); ++pixel)
        shares.add_up(whole.pixels[pixel],
                      [&](std::size_t k) -> glm::vec3& { return parts[k].pixels[pixel]; });
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
