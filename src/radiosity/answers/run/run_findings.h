#pragma once
// What a user must know of how a run ended besides its numbers: that an error is not known, that it
// was not reached, that the estimate has jumped.

#include "radiosity/answers/asked/finding.h"
#include "radiosity/engine/solving/run.h"

#include <span>

namespace hemilux {

/// Returns what there is to say of factors by hemicubes.
[[nodiscard]] Finding hemicube_finding();

/// How a run ended.
struct RunEnd {
    StopRule stop;
    bool estimates_error = true; ///< MethodWork::estimates_error
    double error; ///< estimate of the solution, relative [-]; NaN where it is not known
    bool interrupted = false;
};

/// Returns what there is to say of a run of these steps.
[[nodiscard]] Findings run_findings(std::span<const StepRecord> steps, const RunEnd& end);

} // namespace hemilux
