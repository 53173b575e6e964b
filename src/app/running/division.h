#pragma once
// --divide auto, and what a solution on patches says of the light on the surfaces.

#include "app/settings/settings.h"
#include "io/results/statistics.h"

#include <functional>
#include <memory>

namespace hemilux {

/// Where --divide auto is asked for: which share of the whole error may be left by the division,
/// and which by sampling; their squares add up to two thirds: both
/// are known to some ten or twenty per cent.
inline constexpr double division_share = .65, sampling_share = .5;

/// The whole error that a run with --divide auto is to reach.
[[nodiscard]] double whole_error(const SolveSettings& settings);

/// What --divide auto has made of the mesh.
struct Divided {
    bool patches = false; ///< some were divided
    bool linear = false;  ///< one value on each patch is not enough
    /// Of the mesh as it is now, where there is one: the light by which it was divided.
    Solution rough = {};
    /// Of the mesh if nothing was divided: a run of `gathering` that can go on, after so many
    /// steps. Empty for other methods.
    std::unique_ptr<Solver> begun = nullptr;
    Before before = {};
};

using BeginSolver = std::function<std::unique_ptr<Solver>()>;

/// Divides the mesh until the division leaves no more than its share. Nothing where it is not asked
/// for. `input`: of the run to come, whose solver `begin` makes. A signal ends it, and where there
/// is a time limit half of the time.
[[nodiscard]] Divided divide_as_asked(const SolveSettings& settings, Mesh& mesh,
                                      const SolverInput& input, const BeginSolver& begin,
                                      Statistics& statistics);

/// Makes the light on patches linear functions of the place.
void add_slopes(const SolveSettings& settings, const Mesh& mesh, const Tracer& tracer,
                Solution& solution, const StopFlag& interrupted, Statistics& statistics);

/// Adds the error of the division to the statistics of a solution, and with --divide auto makes the
/// estimated error that of the light as given out.
void add_division_error(Statistics& statistics, const SolveSettings& settings, const Mesh& mesh,
                        const Tracer& tracer, const Solution& solution,
                        const StopFlag& interrupted);

} // namespace hemilux
