#pragma once
// hemilux formfactors: the matrix that the method `matrix` solves with.

#include "app/settings/settings.h"

namespace hemilux {

struct FormFactorSettings {
    SceneSettings scene;
    SolveOptions options;      ///< seed, threads, factors
    std::uint32_t rays = 4096; ///< per patch; a power of two
    std::vector<std::string> outputs;
    std::vector<GivenOption> given; ///< options and their values
    Verbosity verbosity = Verbosity::normal;

    static constexpr std::size_t most_dense = 20'000; ///< patches
};

/// Returns the exit code or throws UsageError, InputError or OutputError.
int formfactors(const FormFactorSettings& settings);

} // namespace hemilux
