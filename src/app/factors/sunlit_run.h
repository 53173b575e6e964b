#pragma once
// The sunlit fractions of `viewfactors --sunlit`: of surfaces, and of points.

#include "app/factors/factor_run.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace hemilux {

/// The sunlit fractions of all surfaces, and of points.
struct SunlitShares {
    std::vector<OpenShare> surfaces, points;
};

/// Finds the fractions for sun `number` by error, seed and threads of the settings. `sun` is the
/// unit vector to it. The result is void if the monitor was interrupted.
[[nodiscard]] SunlitShares sunlit_shares(const ViewFactorSettings& settings,
                                         const FactorScene& scene, const Vec3& sun,
                                         std::size_t number, std::span<const FactorPoint> points,
                                         Monitor& monitor);

/// How far it came.
struct SunlitRun {
    std::size_t suns = 0;           ///< those whose rows are written
    std::size_t exact = 0, all = 0; ///< fractions of surfaces
    double worst_error = 0;         ///< largest standard error [-]
};

/// Finds the fractions of all surfaces and points for each sun and writes a table
/// `sun,surface,sunlit,standard_error`, a row for each of them. Points count from `first_point`. An
/// interrupt ends it after the suns that are complete, which are written. Throws OutputError.
[[nodiscard]] SunlitRun write_sunlit(const std::string& path, const ViewFactorSettings& settings,
                                     const FactorScene& scene, std::span<const Vec3> suns,
                                     std::span<const FactorPoint> points, std::size_t first_point,
                                     Monitor& monitor);

} // namespace hemilux
