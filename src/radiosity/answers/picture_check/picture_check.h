#pragma once
// Whether a picture shows anything, and why it does not.

#include "radiosity/answers/images/image.h"
#include "radiosity/answers/images/tone.h"
#include "radiosity/answers/views/camera_rays.h"

#include <span>
#include <string>

namespace hemilux {

/// A picture, and the light that it is of.
struct ShownPicture {
    const Image& picture; ///< linear light
    Display display;
    const Mesh& mesh;
    const Tracer& tracer;
    std::span<const Vec3> radiosity; ///< linear, by patch [W/m2]
    Camera camera;
};

/// Returns one line for a picture that is nearly black or nearly white, with what makes it so: the
/// camera, the exposure, emitters that fill it, or light that stays elsewhere. Says too where
/// nearly all light stays inside a small part of the scene. It is empty for other pictures.
[[nodiscard]] std::string picture_warning(const ShownPicture& shown);

} // namespace hemilux
