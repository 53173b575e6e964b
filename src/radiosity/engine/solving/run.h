#pragma once
// Runs a solver: it takes steps until a rule ends the run.

#include "radiosity/engine/solving/engine_solver.h"

#include <cstdint>
#include <functional>

namespace hemilux {

/// A row of the steps log.
struct StepRecord {
    std::uint32_t step;
    std::uint64_t rays;     ///< every ray so far
    double seconds;         ///< time since the solver was made
    double estimated_error; ///< relative [-]; NaN where it is unknown
};

/// The steps and the time of a run before it was resumed. They count for the stop rule and the
/// records.
struct Before {
    std::uint32_t steps = 0;
    double seconds = 0; ///< except those of Solution::seconds_density
};

/// A solver that bounds its rays (StopRule::rays) begins no step that may add less than this share
/// of those before.
inline constexpr double least_growth = .5;

/// Takes steps until the rule or the monitor ends the run; then still those that are ready.
/// `after_step` sees each new solution. Returns false when interrupted. At the end of
/// `stop.seconds`, or of one second where that is later, a step is cut short. If it is the first
/// there may be no step at all. At the end of `stop.patience` a step is cut short too. The run also
/// ends where the image is useful: "Useful (Image)" of the paper, sections 3 to 5.
bool run(Solver& solver, const SolverInput& input, const StopRule& stop,
         const std::function<void(const StepRecord&, const Solution&)>& after_step = {},
         const Before& before = {}, const std::function<bool(const Solution& image)>& useful = {});

} // namespace hemilux
