#include "radiosity/answers/lamps/light_of_lamps.h"

#include "parallel/workers.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/scene/mesh.h"

#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace hemilux {
namespace {

/// A layer is gathered to this relative error of its own at the most, however faint it is.
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
    return reflected > 0 ? std::sqrt(errors / reflected) : std::numeric_limits<double>::quiet_NaN();
}

void add_up(const LampShares& shares, const std::vector<PointLight>& whole,
            std::vector<std::vector<PointLight>>& parts) {
    for (std::vector<PointLight>& part : parts)
        part.resize(whole.size());
    for (std::size_t point = 0; point < whole.size(); ++point)
        shares.add_up(whole[point].irradiance,
                      [&](std::size_t k) -> Vec3& { return parts[k][point].irradiance; });
}

/// Adds the gathered light of a layer.
void add_layer(LampLight& light, GatheredLight&& layer) {
    light.points.push_back(layer.points ? std::move(layer.points->value.found.lights)
                                        : std::vector<PointLight>());
    if (layer.picture)
        light.pictures.push_back(std::move(layer.picture->value.image));
    for (std::size_t map = 0; map < layer.lightmaps.size(); ++map)
        light.lightmaps[map].push_back(std::move(layer.lightmaps[map].value.image));
}

} // namespace

std::optional<LampLight> light_of_lamps(const LitScene& scene, const Solution& solution,
                                        const KeepsRays& solver, LayersBy by, Monitor& monitor) {
    const Workers workers(scene.threads);
    LampLight found;
    found.lamps = find_lamp_layers(scene.mesh, by);
    double all_power = 0;
    for (const LampLayer& layer : found.lamps.layers)
        all_power += mean_of_channels(layer.power);
    const std::unique_ptr<Relighting> rays = solver.relighting(workers);
    for (std::uint32_t k = 0; k < found.lamps.layers.size(); ++k) {
        const std::uint64_t before = monitor.rays;
        std::optional<Relit> light =
            rays->light_of(lit_by_layer(scene.mesh, found.lamps, k),
                           mean_of_channels(found.lamps.layers[k].power) / all_power, workers);
        if (!light)
            return std::nullopt;
        found.rays += monitor.rays - before;
        found.patches.push_back(std::move(*light));
    }
    share_whole(scene.mesh, solution, found);
    for (std::size_t k = 0; k < found.patches.size(); ++k)
        found.errors.push_back(error_on_patches(scene.mesh, found, k));
    return found;
}

bool gather_lamps(LampLight& light, const LitScene& scene, const Solution& solution,
                  const GatheredLight& whole, const WantedLight& wanted, const Asked& asked,
                  Monitor& monitor) {
    light.lightmaps.resize(whole.lightmaps.size());
    if (light.patches.size() == 1) {
        add_layer(light, GatheredLight(whole));
        light.errors[0] = whole.largest_error().whole;
        return true;
    }
    if (wanted.points.empty() && wanted.lightmaps.empty() && !wanted.picture)
        return true;
    const ErrorOfPart part{asked.error / std::sqrt(double(light.patches.size())), max_layer_error};
    for (std::uint32_t k = 0; k < light.patches.size(); ++k) {
        const Mesh lit = lit_by_layer(scene.mesh, light.lamps, k);
        const Solution own = solution_of(solution, light.patches[k]);
        Watcher nobody;
        Gatherer gatherer({lit, scene.tracer, own.radiosity, scene.threads}, own, asked, monitor,
                          nobody);
        GatheredLight layer = gather(gatherer, wanted, &whole, part);
        if (monitor.interrupted)
            return false;
        light.rays += gatherer.work().rays();
        light.errors[k] = layer.largest_error().whole;
        add_layer(light, std::move(layer));
    }
    const LampShares shares(light.lamps);
    if (whole.points)
        add_up(shares, whole.points->value.found.lights, light.points);
    if (!light.pictures.empty())
        add_up(shares, whole.picture->value.image, light.pictures);
    for (std::size_t map = 0; map < light.lightmaps.size(); ++map)
        add_up(shares, whole.lightmaps[map].value.image, light.lightmaps[map]);
    return true;
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

} // namespace hemilux
