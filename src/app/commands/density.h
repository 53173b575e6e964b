#pragma once
// hemilux density: what preprocessing found (paper section 5a), as drawings.

#include "app/settings/settings.h"

namespace hemilux {

struct DensitySettings {
    SceneSettings scene;
    SolveOptions options;               ///< depth, threshold, seed, threads
    std::optional<std::uint32_t> patch; ///< whose hemisphere; empty: the largest spread
    std::uint32_t rays = 0;             ///< energy rays to show in it
    ViewSettings view;
    std::vector<std::string> outputs; ///< .svg: a hemisphere; .png: mean densities
    Verbosity verbosity = Verbosity::normal;
};

/// Returns the exit code or throws UsageError, InputError or OutputError.
int density(const DensitySettings& settings);

} // namespace hemilux
