#pragma once
// --divide auto: the mesh is divided until the whole error is as asked for.

#include "app/settings/settings.h"
#include "io/results/statistics.h"
#include "radiosity/engine/solving/run.h"
#include "radiosity/light/light_error/division_error.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hemilux {

/// The shares of the whole error that the division and, at first, sampling may leave, where
/// --divide auto is asked for [-].
inline constexpr double share_of_division = .7, share_of_sampling = .5;

/// The result of --divide auto for the mesh.
struct Divided {
    bool patches = false; ///< some were divided
    bool linear = false;  ///< one value on each patch is not enough
    /// The light by which the mesh was divided, on the patches that the mesh then has; empty if
    /// none was found.
    Solution rough = {};
    std::vector<Slope> slope = {}; ///< by patch, of the light; empty where it is not linear
    /// A run of `stored-transport` on the patches as they are after the division, which can go on
    /// after `steps`. It is empty for other methods, and if it was not begun.
    std::unique_ptr<Solver> begun = nullptr;
    std::vector<StepRecord> steps = {};
    [[nodiscard]] Before before() const {
        return steps.empty() ? Before{} : Before{steps.back().step, steps.back().seconds};
    }
    /// The relative error of sampling that is left for the run, where it is known [-].
    std::optional<double> sampling = {};
    /// The error of the division, if that run does not go on.
    std::optional<DivisionError> error = {};
};

using BeginSolver = std::function<std::unique_ptr<Solver>()>;
/// This finds out what belongs to the patches after a change of the mesh.
using MeshChanged = std::function<void()>;

/// Divides the mesh until the whole error is as asked for, with --for that of the target, as
/// estimated from a run to a share of it. Does nothing where it is not asked for. `input` is that
/// of the run to come, whose solver `begin` makes. It refers to `mesh` and to its needs and target,
/// which `mesh_changed` finds again. A signal ends the division, and where there is a time limit
/// half of the time.
[[nodiscard]] Divided divide_as_asked(const SolveSettings& settings, Mesh& mesh,
                                      const SolverInput& input, const BeginSolver& begin,
                                      const MeshChanged& mesh_changed, Statistics& statistics);

} // namespace hemilux
