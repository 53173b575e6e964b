#pragma once
// Lights without extent (KHR_lights_punctual) as small surfaces of the same flux: radiosity knows
// emitting surfaces only. A lumen counts as a watt, as it does in the candela per square metre of
// an emissive material.
//
// A point light is an icosahedron. A spot light is a disc that looks along its axis: it has the
// flux of its cone, but shines by the cosine law. A directional light is a disc as wide as the sun
// seen from the scene, far outside of it.

#include "geometry/box.h"
#include "io/gltf/document/document.h"
#include "radiosity/paper/scene/scene.h"

#include <string>

namespace hemilux::gltf {

struct PlacedLight {
    Light light;
    Vec3 position;  ///< world units [m]
    Vec3 direction; ///< unit, in which it shines
    std::string name;
};

/// Returns the flux [lm] of a point or spot light whose intensity is 1 [cd] in one channel.
[[nodiscard]] double flux_per_intensity(const Light& light);

/// Adds the emitter, with a material and a group of the light's name. `bounds` are those of the
/// scene without lights.
void add_light(Scene& scene, const PlacedLight& light, const Box& bounds);

} // namespace hemilux::gltf
