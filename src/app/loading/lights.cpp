#include "app/loading/lights.h"

#include "geometry/elementary.h"
#include "geometry/numeric.h"
#include "io/files/text_words.h"
#include "io/scene_files/emitter_shapes.h"
#include "radiosity/engine/rays/point_emitter.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <string_view>

namespace hemilux {
namespace {

std::string numbered(const std::string& name, std::size_t number) {
    return name + " " + std::to_string(number);
}

/// Adds a point or a spot.
void add_light_without_extent(Scene& scene, const LightSettings& light, const std::string& name) {
    constexpr double degree = std::numbers::pi / 180;
    PointEmitter emitter{.name = name, .position = light.at};
    if (light.kind == LightSettings::Kind::spot) {
        emitter.axis = direction_of(light.towards);
        emitter.cos_inner = elementary::cos(degree * light.inner);
        emitter.cos_outer = elementary::cos(degree * light.outer);
    }
    emitter.intensity =
        light.intensity ? *light.intensity : *light.watts / power_per_intensity(emitter);
    add_point_emitter(scene, emitter);
}

void add_lamp(Scene& scene, const LightSettings& light, const std::string& name) {
    if (!light.has_extent()) {
        add_light_without_extent(scene, light, name);
        return;
    }
    const Vec3 normal = direction_of(light.towards);
    const EmitterShape shape = light.kind == LightSettings::Kind::disc
                                   ? disc(light.at, normal, light.width / 2)
                                   : rectangle(light.at, normal, light.width, light.height);
    add_emitter(scene, shape, name, light.emission ? *light.emission : *light.watts / shape.area());
}

} // namespace

void add_lights(Scene& scene, const SceneSettings& settings) {
    if (scene.facets.empty())
        return;
    const Box bounds = bounds_of(scene);
    for (std::size_t i = 0; i < settings.lights.size(); ++i)
        add_lamp(scene, settings.lights[i], numbered("light", i + 1));
    for (std::size_t i = 0; i < settings.suns.size(); ++i)
        add_sun(scene, numbered("sun", i + 1), bounds, settings.suns[i].direction,
                settings.suns[i].irradiance);
    if (settings.sky)
        add_sky(scene, "sky", bounds, *settings.sky);
}

std::vector<std::string> likely_lamps(const Scene& scene) {
    constexpr std::array<std::string_view, 16> words = {
        "lamp",  "light", "bulb",   "lantern", "neon", "glow", "emi",   "sun",
        "torch", "lava",  "candle", "flame",   "fire", "led_", "tubes", "screen"};
    const std::vector<bool> used = materials_in_use(scene);
    std::vector<std::string> names;
    for (std::size_t m = 0; m < used.size(); ++m) {
        const std::string name = small_letters(scene.materials[m].name);
        if (used[m] && std::ranges::any_of(words, [&](std::string_view word) {
                return name.find(word) != std::string::npos;
            }))
            names.push_back(scene.materials[m].name);
    }
    return names;
}

} // namespace hemilux
