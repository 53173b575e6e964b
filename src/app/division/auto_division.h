#pragma once
// --divide auto: the mesh is divided until the whole error is as asked for.

#include "app/settings/settings.h"
#include "io/results/statistics.h"
#include "radiosity/final_gather/division_error.h"
#include "radiosity/solving/run.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hemilux {

/// Where --divide auto is asked for: which share of the whole error may be left by the division,
/// and which by sampling, at first.
inline constexpr double share_of_division = .7, share_of_sampling = .5;

/// Where division was not asked for it makes so many patches at the most: some hundred megabytes,
/// some seconds. Models that have as many are divided only where gathered light would be wrong by
/// more than `error_of_large_models`, and to that error, if they have not too many.
inline constexpr std::size_t most_patches_by_default = 20'000,
                             most_patches_of_large_models = 200'000;
inline constexpr double error_of_large_models = .05;

/// Whether a plain run on so many patches divides them: where the method is the standard one, and
/// what was asked for says nothing of patches or single steps.
[[nodiscard]] bool divides_by_default(const SolveSettings& settings, std::size_t patches);

/// A run to an error ends at a number of rays at the latest, if nothing else ends it.
[[nodiscard]] std::uint64_t default_max_rays(std::size_t patches);

/// What --divide auto has made of the mesh.
struct Divided {
    bool patches = false; ///< some were divided
    bool linear = false;  ///< one value on each patch is not enough
    /// The light by which the mesh was divided, on the patches that it has now; empty if none was
    /// found.
    Solution rough = {};
    std::vector<Slope> slope = {}; ///< by patch, of the light; empty where it is not linear
    /// A run of `stored-transport` on the patches as they are now, which can go on after the steps
    /// of `before`. Empty for other methods, and if it was not begun.
    std::unique_ptr<Solver> begun = nullptr;
    Before before = {};
    StepRecord last = {}; ///< of these steps
    /// The error of sampling that is left for the run, where it is known.
    std::optional<double> sampling = {};
    /// The error of the division, if that run does not go on.
    std::optional<DivisionError> error = {};
    /// In its place what the division leaves on gathered light, where that is given out.
    std::optional<DivisionError> spread = {};
};

using BeginSolver = std::function<std::unique_ptr<Solver>()>;
/// Finds out what belongs to the patches as they are now.
using MeshChanged = std::function<void()>;

/// Divides the mesh until the whole error is as asked for, with --for that of the target, as
/// estimated from a run to a share of it. Nothing where it is not asked for. `input`: of the run to
/// come, whose solver `begin` makes; it refers to `mesh` and to its needs and target, which
/// `mesh_changed` finds anew. A signal ends it, and where there is a time limit half of the time.
[[nodiscard]] Divided divide_as_asked(const SolveSettings& settings, Mesh& mesh,
                                      const SolverInput& input, const BeginSolver& begin,
                                      const MeshChanged& mesh_changed, Statistics& statistics);

/// The solution that is given out, with the slopes of its patches.
[[nodiscard]] Solution with_slopes(Solution solution, const Divided& divided);

} // namespace hemilux
