#pragma once
// Runs several methods side by side, each several times, and judges every step by a reference.

#include "app/loading/reference.h"
#include "app/report/run_data.h"
#include "app/settings/settings.h"
#include "io/results/tables.h"
#include "radiosity/answers/run/problem.h"
#include "radiosity/light/final_gather/known_light.h"
#include "radiosity/paper/solution/solve_error.h"

#include <functional>
#include <memory>
#include <vector>

namespace hemilux {

/// One run of one variant.
struct MethodRun {
    std::vector<StepRow> rows;
    /// The light of the first run after steps 1, 2, 4 and so on and after the last one, for a page.
    /// Other runs have none.
    std::vector<LightOfStep> lights;
    std::uint64_t bytes_density = 0;
    bool complete = false; ///< not interrupted
};

/// All runs of one variant that were begun.
struct MethodRuns {
    MethodVariant variant;
    std::vector<MethodRun> runs;
    std::vector<Vec3> radiosity; ///< light at the end of the first run that has a step [W/m2]
};

/// The things that the runs have in common.
struct Comparison {
    const Mesh& mesh;
    const Tracer& tracer;
    const CompareSettings& settings;
    const Reference& reference;
    const KnownLight* light; ///< none: errors are those on the patches
    Monitor& monitor;
    std::shared_ptr<const Problem> problem;
    std::span<const std::string> warnings; ///< messages of reading the scene
    double unit;                           ///< unit of the light on a page [W/m2]
    double bytes_needed = 0;               ///< MemoryNeed::all()
};

/// Runs the methods. `after_step` gets the share of all runs that is done, 0 to 1. `fault` becomes
/// what kept a step from being done; the results are then those of the steps before.
[[nodiscard]] std::vector<MethodRuns>
run_methods(const Comparison& comparison, std::optional<SolveError>& fault,
            const std::function<void(const StepRow&, double share)>& after_step);

} // namespace hemilux
