#pragma once
// Holds the solutions of independent batches of form factors. Each is found from its last one on;
// their mean is the result, and how they spread is its error.

#include "radiosity/engine/linear/energy_ledger.h"
#include "radiosity/engine/linear/radiosity_system.h"
#include "radiosity/paper/solution/solution.h"
#include "radiosity/paper/solving/solver.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace hemilux {

/// What solving one batch has found out besides its light.
struct SolvedBatch {
    EnergyBalance energy;
    double unsolved = 0; ///< ArrivingLight::unsolved
};

/// Solves B = E + rho F B from `radiosity` on, which is then the solution with its energy closed
/// (close_energy).
[[nodiscard]] SolvedBatch solve_closed(const FormFactorProduct& multiply,
                                       const Transport& transport, const SolverInput& input,
                                       std::vector<Vec3>& radiosity);

class BatchSolutions {
  public:
    /// There are at least two batches; each begins with the solution before the first step.
    BatchSolutions(const SolverInput& input, std::size_t batches, const Solution& before);

    /// Finds the radiosity of a batch from its last one on, and where its power goes.
    using SolveBatch = std::function<SolvedBatch(std::size_t batch, std::vector<Vec3>& radiosity)>;
    /// Returns whether all were solved and not interrupted. Returns nothing where the rays of a
    /// batch have seen no way out for the light: all then begin anew from the `last` solution.
    /// Throws SolveError where a result is not finite.
    [[nodiscard]] std::optional<bool> solve(const SearchForWayOut& search, const Solution& last,
                                            const SolveBatch& solve_batch);

    /// Sets the solution's radiosity, energy, variance and degrees of freedom. Returns the
    /// variance of the mean by patch and channel [(W/m2)^2], pooled with neighbours that are alike.
    [[nodiscard]] std::vector<Vec3> combine(Solution& solution) const;
    /// Adds what the solver has left unsolved to the solution's errors, when these are known.
    void add_unsolved_to(Solution& solution) const;

  private:
    SolverInput input_;
    std::vector<std::vector<Vec3>> radiosity_; ///< light by batch and patch [W/m2]
    Vec3 absorbed_{0.0}, escaped_{0.0};        ///< power, mean of the batches, local units
    double unsolved_ = 0;                      ///< mean of the batches
};

} // namespace hemilux
