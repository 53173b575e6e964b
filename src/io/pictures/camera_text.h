#pragma once
// A camera as options describe it.

#include "radiosity/answers/views/camera.h"

#include <optional>
#include <string_view>

namespace hemilux {

/// Reads eye and target, "ex,ey,ez,tx,ty,tz". The vertical angle in degrees, ",fov", or the angle
/// and the direction upwards, ",fov,ux,uy,uz", may follow. Blanks may stand around the numbers. The
/// result is empty for any other text. It is empty too where eye and target are one point, the
/// angle is not between 0 and 180, or the direction is 0.
[[nodiscard]] std::optional<Camera> parse_camera(std::string_view text);

} // namespace hemilux
