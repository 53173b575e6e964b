#pragma once
// The table of `viewfactors --sunlit`: sunlit fractions of surfaces, and of points.

#include "app/settings/view_factor_settings.h"
#include "radiosity/answers/surfaces/surface_sunlight.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace hemilux {

/// How far it came.
struct SunlitRun {
    std::size_t suns = 0;                     ///< those whose rows are written
    std::size_t exact = 0, all = 0;           ///< fractions of surfaces
    double worst_error = 0;                   ///< largest standard error [-]
    std::vector<std::vector<OpenShare>> kept; ///< by sun, if they were asked for
};

/// Finds the fractions of all surfaces and points for each sun and writes a table
/// `sun,surface,sunlit,standard_error`, a row for each of them. Points count from `first_point`. An
/// interrupt ends it after the suns that are complete, which are written. With `keeps` the result
/// has all fractions. Throws OutputError.
[[nodiscard]] SunlitRun write_sunlit(const std::string& path, const ViewFactorSettings& settings,
                                     const FactorScene& scene, std::span<const Vec3> suns,
                                     std::span<const FactorPoint> points, std::size_t first_point,
                                     bool keeps, Monitor& monitor);

} // namespace hemilux
