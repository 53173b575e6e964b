#pragma once
// Several runs of one problem at once, step by step, so that whatever else disturbs the machine
// disturbs all alike. The next step is always that of the run which is least far in its budget.

#include "radiosity/answers/run/run.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace hemilux {

/// The budget of a run: one of the three.
struct Budget {
    std::optional<double> rays;                 ///< density rays included
    std::optional<double> seconds;              ///< time of its own, preprocessing included
    std::optional<double> error;                ///< true error at which a run ends, relative [-]
    static constexpr double default_steps = 64; ///< steps of the mean rays per patch
    /// A run that does not reach the error ends after so many times the default number of rays.
    static constexpr double most_for_error = 64;

    /// Returns the budget for steps of so many rays in all: the default one where none is given,
    /// and an end by rays for one of an error.
    [[nodiscard]] Budget with_end(double rays_of_step) const;
};

/// A run with a budget. Its time is the sum of its own steps and of what it does before the first.
class BudgetedRun {
  public:
    /// `options` are those of the run but for a step's rays, of which a budget of time may leave
    /// fewer. Throws SolveError.
    BudgetedRun(const std::shared_ptr<const Problem>& problem, const Method& method,
                SolveOptions options, const Budget& budget, Monitor& monitor);

    /// Takes a step; false when it was interrupted, or cut short as it took much longer than the
    /// budget.
    bool step();
    /// Takes the true error after the last step, relative [-], for a budget of that.
    void judge(double error) { true_error_ = error; }
    /// Returns whether the next step would end farther from the budget than the last one did.
    [[nodiscard]] bool is_done() const;
    /// Returns the share of the budget that is used up, 0 to 1.
    [[nodiscard]] double share() const;
    [[nodiscard]] const Run& run() const { return run_; }

  private:
    [[nodiscard]] std::optional<double> seconds_left() const;
    [[nodiscard]] double limit() const { return budget_.rays ? *budget_.rays : *budget_.seconds; }
    [[nodiscard]] double used() const;

    Budget budget_;
    Run run_;
    bool cut_short_ = false;
    std::optional<double> true_error_ = {};
    double last_step_ = 0, step_before_ = 0; ///< parts of the budget that steps used
};

/// Takes steps until all have used up their budgets or the monitor is interrupted; `after_step`
/// gets the run that has done one. Throws SolveError.
void go_on_side_by_side(std::vector<BudgetedRun>& runs, const Monitor& monitor,
                        const std::function<void(std::size_t run)>& after_step);

} // namespace hemilux
