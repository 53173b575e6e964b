#include "io/gltf/lights.h"

#include "geometry/elementary.h"
#include "radiosity/engine/rays/point_emitter.h"
#include "radiosity/light/lamps/emitter_shapes.h"

namespace hemilux::gltf {

void add_light(Scene& scene, const PlacedLight& placed, const Box& bounds) {
    const Light& light = placed.light;
    const Vec3 intensity = light.intensity * light.colour;
    if (light.kind == Light::Kind::directional) {
        add_sun(scene, placed.name, bounds, placed.direction, intensity);
        return;
    }
    PointEmitter emitter{.name = placed.name,
                         .position = placed.position,
                         .axis = placed.direction,
                         .intensity = intensity};
    if (light.kind == Light::Kind::spot) {
        emitter.cos_inner = elementary::cos(light.inner_cone);
        emitter.cos_outer = elementary::cos(light.outer_cone);
    }
    add_point_emitter(scene, emitter);
}

} // namespace hemilux::gltf
