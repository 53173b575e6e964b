#pragma once
// The lights of KHR_lights_punctual. A lumen counts as a watt, as it does in the candela per square
// metre of an emissive material.
//
// Point and spot lights are lights without extent. A directional light is a disc as wide as the sun
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

/// Adds the light. A directional one is an emitter with a material and a group of the light's name.
/// `bounds` are those of the scene without lights.
void add_light(Scene& scene, const PlacedLight& light, const Box& bounds);

} // namespace hemilux::gltf
