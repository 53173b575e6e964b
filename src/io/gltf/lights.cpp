#include "io/gltf/lights.h"

#include "geometry/elementary.h"
#include "io/scene_files/emitter_shapes.h"

#include <numbers>

namespace hemilux::gltf {
namespace {

constexpr double pi = std::numbers::pi;

/// The radius of point and spot lights, relative to the diagonal of the scene.
constexpr double small_radius = 0.002;

} // namespace

/// The intensity of a spot falls between its two cones as ((cos - cos outer) / (cos inner - cos
/// outer))^2, whose integral over cos is a third.
double flux_per_intensity(const Light& light) {
    if (light.kind == Light::Kind::point)
        return 4 * pi;
    const double inner = elementary::cos(light.inner_cone),
                 outer = elementary::cos(light.outer_cone);
    return 2 * pi * (1 - inner + (inner - outer) / 3);
}

void add_light(Scene& scene, const PlacedLight& light, const Box& bounds) {
    const Vec3 intensity = light.light.intensity * light.light.colour;
    if (light.light.kind == Light::Kind::directional) {
        add_sun(scene, light.name, bounds, light.direction, intensity);
        return;
    }
    const double radius = small_radius * glm::length(bounds.extent());
    const EmitterShape shape = light.light.kind == Light::Kind::spot
                                   ? disc(light.position, light.direction, radius)
                                   : icosahedron(light.position, radius);
    add_emitter(scene, shape, light.name,
                intensity * (flux_per_intensity(light.light) / shape.area()));
}

} // namespace hemilux::gltf
