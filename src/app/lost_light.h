#pragma once
// A black picture with an error of 0 % must not pass for a result.

#include "app/settings.h"
#include "radiosity/light_shares.h"

#include <span>
#include <string>

namespace hemilux {

/// Words for a run whose light was lost: nothing is lit, or more than nine tenths of the light fell
/// on backs or left the scene. Empty for others.
[[nodiscard]] std::string lost_light_text(const Mesh& mesh, std::span<const Vec3> radiosity,
                                          const LightShares& light, Sides sides);

} // namespace hemilux
