#pragma once
// Defines what a run asks of the engine's solvers besides their steps: plans, steps that are ready,
// and a state that can be kept.

#include "radiosity/paper/solving/solver.h"

namespace hemilux {

class StateWriter;
class StateReader;

class EngineSolver : public Solver {
  public:
    /// Plans the following steps for this error [-], in place of that of SolveOptions::stop.
    virtual void aim_at(double /*error*/) {}
    /// Returns the number of next steps that are worked out already: they cost no time.
    [[nodiscard]] virtual std::uint32_t steps_ready() const { return 0; }

    /// Saves, between two steps, all that the next ones depend on and that a new solver of the same
    /// scene and options would not find again by itself. Throws std::logic_error unless
    /// Method::can_resume() holds.
    virtual void save(StateWriter& state) const;
    /// Makes a new solver go on where the saved one was. Throws StateError for what save() cannot
    /// have written; the solver is then of no use.
    virtual void load(StateReader& state);
};

} // namespace hemilux
