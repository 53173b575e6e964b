#pragma once
// Estimates the light that dark patches may receive from bright ones that none of their rays has
// met. It may come through a pinhole, or far through doors that stand in a line.

#include "geometry/vector.h"

#include <span>
#include <vector>

namespace hemilux {

/// The number of rays that might have met something, at most, though none did (Hanley and
/// Lippman-Hand 1983, "If nothing goes wrong, is everything all right?"). It does not depend on the
/// number of rays.
inline constexpr double rule_of_three = 3;

/// The known properties of the light, all by patch.
struct LightFoundByRays {
    std::span<const double> area;      ///< local units
    std::span<const Vec3> reflectance; ///< [-]
    std::span<const Vec3> incident;    ///< arrives [W/m2]
    std::span<const Vec3> leaving;     ///< light that rays are to find [W/m2]
    std::span<const double> rays;      ///< number of rays of the patch
};

/// Returns the mean of `leaving`, weighted by itself: the radiosity of the patches that most light
/// comes from [W/m2].
[[nodiscard]] Vec3 bright_radiosity(const LightFoundByRays& light);

/// Returns, by patch, the light that it would reflect [W/m2] if three rays had met something
/// bright. The rays are those of all patches that are about as dark as it and those by which bright
/// patches look at it.
[[nodiscard]] std::vector<Vec3> missed_by_rays(const LightFoundByRays& light);

} // namespace hemilux
