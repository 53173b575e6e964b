#pragma once
// Compute Radiosity, the loops of paper section 5b, for any strategy.
//
// Each step is a complete, unbiased solution of all bounces (stepwise.h). Power is shot from all
// patches that hold some; what arrives is reflected and shot in turn, until nothing is left. Rays
// are allocated in proportion to the power to be shot (docs/paper/decisions.md, D10). So each
// carries about the same, unless the strategy gives some patches more and weaker ones. Numbers of
// rays are made whole by systematic sampling over all patches and cells at once. This is unbiased
// and ends the series of bounces by itself.

#include "radiosity/engine/shooting/bounces.h"
#include "radiosity/engine/shooting/stepwise.h"
#include "radiosity/engine/solving/method.h"

#include <memory>

namespace hemilux {

class ShootingSolver final : public StepwiseSolver {
  public:
    ShootingSolver(const SolverInput& input, MakeStrategy make_strategy,
                   const ShootingRules& rules);

  private:
    bool solve_once(const StepTask& task, StepResult& result) override;
    [[nodiscard]] bool steps_are_alike() const override { return !tools_.strategy->step_hook(); }
    void save_more(StateWriter& state) const override;
    /// Also throws StateError if the strategy would take far more rays than are asked for.
    void load_more(StateReader& state) override;

    ShootingTools tools_;
};

/// Makes the solver of a strategy, for Method::make. With `has_literal`, the option --literal
/// chooses its rules; without it they are the unbiased ones.
template <MakeStrategy make_strategy, bool has_literal = false>
[[nodiscard]] std::unique_ptr<EngineSolver> shoot_with(const SolverInput& input) {
    return std::make_unique<ShootingSolver>(
        input, make_strategy, has_literal ? shooting_rules(input.options) : ShootingRules{});
}

} // namespace hemilux
