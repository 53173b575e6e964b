#include "app/loading/lights.h"

#include "geometry/elementary.h"
#include "geometry/numeric.h"
#include "io/files/error.h"
#include "io/files/text_words.h"
#include "io/scene_files/ies.h"
#include "radiosity/engine/rays/point_emitter.h"
#include "radiosity/light/lamps/emitter_shapes.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <string_view>

namespace hemilux {
namespace {

std::string numbered(const std::string& name, std::size_t number) {
    return name + " " + std::to_string(number);
}

/// Returns the direction C = 0: the part of the one asked for, or of the coordinate axis nearest to
/// being perpendicular, that is across the axis of the light.
Vec3 side_of(const LightSettings& light, const Vec3& axis) {
    const Vec3 a = glm::abs(axis);
    const Vec3 nearest = a.x <= a.y && a.x <= a.z ? Vec3(1, 0, 0)
                         : a.y <= a.z             ? Vec3(0, 1, 0)
                                                  : Vec3(0, 0, 1);
    const Vec3 asked = light.across == Vec3(0.0) ? nearest : direction_of(light.across);
    return glm::normalize(asked - glm::dot(asked, axis) * axis);
}

/// Adds a point, a spot or a measured lamp.
void add_light_without_extent(Scene& scene, const LightSettings& light, const std::string& name) {
    constexpr double degree = std::numbers::pi / 180;
    PointEmitter emitter{.name = name, .position = light.at};
    if (light.kind != LightSettings::Kind::point)
        emitter.axis = direction_of(light.towards);
    if (light.kind == LightSettings::Kind::spot) {
        emitter.cos_inner = elementary::cos(degree * light.inner);
        emitter.cos_outer = elementary::cos(degree * light.outer);
    }
    if (light.kind == LightSettings::Kind::ies) {
        emitter.table = read_ies(light.photometry);
        emitter.side = side_of(light, emitter.axis);
        emitter.intensity = light.scale.value_or(Vec3(1.0));
        if (light.watts && !(power_per_intensity(emitter) > 0))
            throw InputError(light.photometry, "expected a lamp that shines, to scale it to watts");
    }
    if (light.intensity)
        emitter.intensity = *light.intensity;
    if (light.watts)
        emitter.intensity = *light.watts / power_per_intensity(emitter);
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

bool emits(const Scene& scene) {
    const std::vector<bool> used = materials_in_use(scene);
    for (std::size_t m = 0; m < used.size(); ++m)
        if (used[m] && scene.materials[m].emission != Vec3(0.0))
            return true;
    return std::ranges::any_of(point_emitters_of(scene), [](const PointEmitter& emitter) {
        return emitter.intensity != Vec3(0.0);
    });
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
