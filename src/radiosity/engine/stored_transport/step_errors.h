#pragma once
// Concludes from how the batches of rays differ after a step of stored transport. It finds the
// errors that the solution reports, and what the next rays are planned by.

#include "parallel/workers.h"
#include "radiosity/engine/stored_transport/transport_errors.h"
#include "radiosity/paper/solution/solution.h"

#include <optional>
#include <vector>

namespace hemilux {

class StateReader;
class StateWriter;
class TargetAim;
struct Needs;

/// Holds how the light differs between the batches.
struct BatchSpread {
    double freedom = 0;         ///< effective degrees of freedom (error_spread.h)
    double direct_variance = 0; ///< variance by shadow rays: sum over patches, as Solution's
    /// The same by patch, as if each were of the target; -1 where it has no shadow rays.
    std::vector<double> direct_variances;
};

[[nodiscard]] BatchSpread spread_of_batches(const TransportResult& result, const TargetAim& aim,
                                            const Workers& workers);

/// Holds what is known of the error after a step, in the unit of Solution::variance.
struct StepErrors {
    double variance = 0;       ///< variance that more rays lower, all but `missed_in_dark`
    double from_emitters = 0;  ///< the part of it that comes from shadow rays
    double missed_in_dark = 0; ///< the same as that of TransportErrors

    StepErrors() = default;
    StepErrors(const TransportErrors& errors, const BatchSpread& spread);
    /// Returns the relative error that the solution reports, except for what may be missed in the
    /// dark. The solution is left as it is.
    [[nodiscard]] double relative(const Mesh& mesh, Solution& solution) const;

    void save(StateWriter& state) const;
    /// Throws StateError for what save() cannot have written.
    void load(StateReader& state);
};

/// Sets what the solution says of its errors.
void report(const TransportErrors& errors, const BatchSpread& spread, const Needs& needs,
            Solution& solution);

} // namespace hemilux
