#pragma once
// A run: steps until a rule ends it.

#include "radiosity/solving/solver.h"

#include <cstdint>
#include <functional>

namespace hemilux {

/// A row of the steps log.
struct StepRecord {
    std::uint32_t step;
    std::uint64_t rays; ///< every ray so far
    double seconds;     ///< since the solver was made
    double estimated_error;
};

/// What a resumed run did before, which counts for the stop rule and the records.
struct Before {
    std::uint32_t steps = 0;
    double seconds = 0; ///< but for those of Solution::seconds_density
};

/// Steps until the rule or the monitor ends the run; then still those that are ready. `after_step`
/// sees each new solution. Returns false when interrupted. At the end of
/// `stop.seconds`, or of one second where that is later, a step is cut short: if it is the first
/// there may be no step at all.
bool run(Solver& solver, const SolverInput& input, const StopRule& stop,
         const std::function<void(const StepRecord&, const Solution&)>& after_step = {},
         const Before& before = {});

} // namespace hemilux
