#pragma once
// The light that dark patches may receive from bright ones that none of their rays has met: through
// a pinhole, or far through doors that stand in a line.

#include "geometry/vector.h"

#include <span>
#include <vector>

namespace hemilux {

/// Of N rays none of which met something, up to this many might have (Hanley and Lippman-Hand 1983,
/// "If nothing goes wrong, is everything all right?").
inline constexpr double rule_of_three = 3;

/// What is known of the light, all by patch.
struct LightFoundByRays {
    std::span<const double> area;
    std::span<const Vec3> reflectance;
    std::span<const Vec3> incident; ///< arrives [W/m2]
    std::span<const Vec3> leaving;  ///< that rays are to find [W/m2]
    std::span<const double> rays;   ///< of the patch
};

/// The mean of `leaving`, weighted by itself: the radiosity of the patches that most light comes
/// from [W/m2].
[[nodiscard]] Vec3 bright_radiosity(const LightFoundByRays& light);

/// By patch: the light that it would reflect [W/m2] if three rays had met something bright, among
/// those of all patches that are about as dark as it and those by which bright patches look at it.
[[nodiscard]] std::vector<Vec3> missed_by_rays(const LightFoundByRays& light);

} // namespace hemilux
