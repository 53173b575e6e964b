#pragma once
// hemilux density: what preprocessing found (paper section 5a, or 4), as drawings.

#include "app/settings/settings.h"

namespace hemilux {

struct DensitySettings {
    SceneSettings scene;
    const Method* method = &method_of(Role::paper); ///< whose hemispheres; or the forerunner's
    SolveOptions options;                           ///< how they are divided, seed, threads
    std::optional<std::uint32_t> patch;             ///< whose hemisphere; empty: the largest spread
    std::uint32_t part = 0;                         ///< of the patch: whose is shown from above
    std::uint32_t rays = 0;                         ///< energy rays to show in it
    bool plane = false;                             ///< a cross-section instead (figure 1)
    ViewSettings view;
    std::vector<std::string> outputs; ///< .svg: a hemisphere; .png: mean densities
    std::vector<GivenOption> given;   ///< options and their values
    Verbosity verbosity = Verbosity::normal;
};

/// Returns the exit code or throws UsageError, InputError or OutputError.
int density(DensitySettings settings);

} // namespace hemilux
