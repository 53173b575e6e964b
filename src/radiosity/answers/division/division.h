#pragma once
// Patches are divided until the whole error of a run is as asked for, and the run on them is begun.

#include "radiosity/answers/run/run.h"
#include "radiosity/light/division/adaptive_division.h"
#include "radiosity/light/light_error/division_error.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace hemilux {

/// The shares of the whole error that the division and, at first, sampling may leave [-].
inline constexpr double share_of_division = .7, share_of_sampling = .5;

/// The most patches that a division makes where it was not asked for: some hundred megabytes, some
/// seconds. Models that have as many are not divided.
inline constexpr std::size_t max_patches_by_default = 20'000;

/// What is chosen of a division.
struct DivisionChoices {
    double error = .05; ///< the whole error that the run is to reach, with a target that of it [-]
    std::size_t max_patches = AdaptiveDivision{}.max_patches;
    /// The method that finds the light to divide by; a run by it goes on after the division.
    const Method* standard = nullptr;
};

/// What a division took.
struct DivisionWork {
    std::uint64_t rays = 0;       ///< of rough solutions that were dropped, and of points
    std::uint64_t rays_error = 0; ///< to find out what the division leaves
    double seconds = 0;           ///< without the steps of the run that goes on [s]
    double seconds_error = 0;
};

struct Divided {
    std::shared_ptr<const Problem> problem; ///< of the patches as they are then
    bool linear = false;                    ///< one value on each patch is not enough
    /// The light by which the mesh was divided, on the patches that the mesh then has; empty if
    /// none was found, or if the run has it.
    Solution rough = {};
    std::vector<Slope> slope = {}; ///< by patch, of the light; empty where it is not linear
    /// The run on these patches by the standard method, which can go on; empty for other methods,
    /// and if it was not begun.
    std::optional<Run> run = {};
    /// The relative error of sampling that is left for the run, where it is known [-].
    std::optional<double> sampling = {};
    /// The error of the division, if that run does not go on after `steps`.
    std::optional<DivisionError> error = {};
    std::size_t steps = 0;
    DivisionWork work = {};
};

/// Divides the mesh of the problem until the whole error is as asked for, as estimated from a run
/// to a share of it. The monitor ends it, and where there is a time limit half of the time. The
/// watcher is told of each round. Throws SolveError.
[[nodiscard]] Divided divide(Problem problem, const RunChoices& run, const DivisionChoices& choices,
                             Monitor& monitor, Watcher& watcher);

} // namespace hemilux
