#pragma once
// A pinhole camera, given by the user or a scene file, or chosen for a scene.

#include "geometry/vector.h"

namespace hemilux {

/// A camera in world units [m].
struct Camera {
    Vec3 eye, target;
    Vec3 up{0, 1, 0};
    double vertical_fov_degrees = 45;
};

} // namespace hemilux
