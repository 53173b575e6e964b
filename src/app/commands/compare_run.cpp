#include "app/commands/compare_run.h"

#include "app/memory/memory.h"
#include "app/running/step_size.h"
#include "parallel/stopwatch.h"
#include "radiosity/engine/emitters/lit_by_points.h"
#include "radiosity/engine/solving/shared_stop.h"
#include "radiosity/engine/solving/time_limit.h"

#include <algorithm>
#include <bit>
#include <memory>

namespace hemilux {

namespace {

/// Returns the budget as given, or the default number of rays.
Budget budget_of(const Comparison& comparison) {
    Budget budget = comparison.settings.budget;
    const double usual = Budget::default_steps * comparison.settings.options.rays *
                         static_cast<double>(comparison.mesh.patches().size());
    if (budget.error)
        budget.rays = Budget::most_for_error * usual;
    else if (!budget.rays && !budget.seconds)
        budget.rays = usual;
    return budget;
}

/// A method at work. Its time is the sum of its own steps and of what it does before the first.
class Runner {
  public:
    Runner(const Comparison& comparison, const MethodVariant& variant, std::uint32_t run,
           const Budget& budget)
        : comparison_(comparison), variant_(variant), run_(run), budget_(budget),
          options_(variant.applied_to(
              with_memory(comparison.settings.options, comparison.settings.scene,
                          comparison.bytes_needed, comparison.settings.variants.size()))) {
        options_.rays = rays_of_step(options_.rays, budget.seconds, *variant.method,
                                     comparison.mesh.patches().size());
        options_.seed += run;
        options_.literal = options_.literal && variant.method->has_literal;
        const Stopwatch preparing;
        solver_ = make_solver(*variant.method, {.mesh = comparison.mesh,
                                                .tracer = comparison.tracer,
                                                .options = options_,
                                                .monitor = comparison.monitor,
                                                .needs = comparison.needs});
        seconds_ = ranks().of_first(preparing.seconds());
    }

    /// Does a step; false when it was interrupted, or cut short as it took much longer than the
    /// budget.
    bool step() {
        const double before = used();
        const Stopwatch stepping;
        const TimeLimit limit(comparison_.monitor.interrupted, seconds_left());
        if (agree(comparison_.monitor.interrupted) || !solver_->step()) {
            cut_short_ = !comparison_.monitor.interrupted.is_wished();
            return false;
        }
        seconds_ += ranks().of_first(stepping.seconds());
        step_before_ = last_step_;
        last_step_ = used() - before;
        result_.rows.push_back(row());
        if (std::has_single_bit(result_.rows.size()))
            keep_light();
        return true;
    }

    /// Returns whether the next step would end farther from the budget than the last one did.
    [[nodiscard]] bool done() const {
        if (cut_short_)
            return true;
        if (result_.rows.empty())
            return false;
        if (budget_.error && error() <= *budget_.error)
            return true;
        const double growth =
            step_before_ > 0 ? std::clamp(last_step_ / step_before_, 1.0, 2.0) : 1.0;
        return solver_->finished() || used() + growth * last_step_ / 2 > limit();
    }
    [[nodiscard]] double share() const {
        if (done())
            return 1;
        if (budget_.error && !result_.rows.empty()) // rays go as the inverse square of the error
            return std::min(.99, *budget_.error / error() * (*budget_.error / error()));
        return std::min(1.0, used() / limit());
    }
    [[nodiscard]] const std::vector<Vec3>& radiosity() const {
        return solver_->solution().radiosity;
    }
    [[nodiscard]] const StepRow& last_row() const { return result_.rows.back(); }

    [[nodiscard]] MethodRun result() {
        if (!result_.rows.empty() && !std::has_single_bit(result_.rows.size()))
            keep_light();
        result_.bytes_density = solver_->solution().bytes_density;
        result_.complete = done();
        return std::move(result_);
    }

  private:
    /// Returns the time limit of a step: it may end as far behind the budget as another would end
    /// before it.
    [[nodiscard]] std::optional<double> seconds_left() const {
        constexpr double least = 1;
        if (!budget_.seconds)
            return std::nullopt;
        return std::max(2 * *budget_.seconds - seconds_, least);
    }
    /// Returns the true error after the last step, of what the curves show.
    [[nodiscard]] double error() const {
        const StepRow& last = result_.rows.back();
        return last.total_error.value_or(last.error->all);
    }
    [[nodiscard]] const Ranks& ranks() const { return *comparison_.settings.ranks; }
    [[nodiscard]] double limit() const { return budget_.rays ? *budget_.rays : *budget_.seconds; }
    [[nodiscard]] double used() const {
        return budget_.rays ? static_cast<double>(rays()) : seconds_;
    }
    [[nodiscard]] std::uint64_t rays() const {
        return solver_->solution().rays_energy + solver_->solution().rays_density;
    }
    [[nodiscard]] StepRow row() const {
        const Solution& solution = solver_->solution();
        const auto step = static_cast<std::uint32_t>(result_.rows.size() + 1);
        return {variant_.name,
                run_,
                StepRecord{step, rays(), seconds_, estimated_error(comparison_.mesh, solution)},
                comparison_.reference.error(comparison_.mesh, solution.radiosity),
                comparison_.light ? std::optional(comparison_.light->error(solution.radiosity))
                                  : std::nullopt,
                comparison_.settings.relative_mse
                    ? std::optional(
                          comparison_.reference.relative_mse(comparison_.mesh, solution.radiosity))
                    : std::nullopt};
    }

    void keep_light() {
        if (run_ == 0 && !comparison_.settings.report.empty())
            result_.lights.push_back({result_.rows.back().record.step,
                                      halves_of(solver_->solution().radiosity, comparison_.unit)});
    }

    const Comparison& comparison_;
    const MethodVariant& variant_;
    std::uint32_t run_;
    Budget budget_;
    SolveOptions options_;
    std::unique_ptr<Solver> solver_;
    bool cut_short_ = false;
    double seconds_ = 0;
    double last_step_ = 0, step_before_ = 0; ///< parts of the budget that steps used
    MethodRun result_;
};

using Runners = std::vector<std::unique_ptr<Runner>>;

double mean_share(const Runners& runners, std::size_t of) {
    double sum = 0;
    for (const auto& runner : runners)
        sum += runner->share();
    return sum / static_cast<double>(of);
}

/// Does one run of all methods, each until its budget is used up or all are interrupted. The
/// runners are filled in as they are made, so that they remain when a step cannot be done.
void run_once(const Comparison& comparison, std::uint32_t run, Runners& runners,
              const std::function<void(const StepRow&, double share)>& after_step) {
    const Budget budget = budget_of(comparison);
    const std::vector<MethodVariant>& variants = comparison.settings.variants;
    for (const MethodVariant& variant : variants) {
        if (comparison.monitor.interrupted)
            return;
        runners.push_back(std::make_unique<Runner>(comparison, variant, run, budget));
    }
    while (!comparison.monitor.interrupted) {
        const auto least = std::ranges::min_element(
            runners, {}, [](const auto& runner) { return runner->share(); });
        if ((*least)->done())
            break;
        if (!(*least)->step())
            continue;
        after_step((*least)->last_row(), mean_share(runners, variants.size()));
    }
}

} // namespace

std::vector<MethodRuns>
run_methods(const Comparison& comparison, std::optional<SolveError>& fault,
            const std::function<void(const StepRow&, double share)>& after_step) {
    std::vector<MethodRuns> results;
    for (const MethodVariant& variant : comparison.settings.variants)
        results.push_back({variant, {}, {}});
    const std::uint32_t runs = comparison.settings.runs;
    for (std::uint32_t run = 0; run < runs && !comparison.monitor.interrupted && !fault; ++run) {
        Runners runners;
        try {
            run_once(comparison, run, runners, [&](const StepRow& row, double share) {
                after_step(row, (run + share) / runs);
            });
        } catch (const SolveError& error) {
            fault = error;
        }
        for (std::size_t m = 0; m < runners.size(); ++m) {
            results[m].runs.push_back(runners[m]->result());
            if (results[m].radiosity.empty() && !results[m].runs.back().rows.empty())
                results[m].radiosity = runners[m]->radiosity();
        }
    }
    return results;
}

} // namespace hemilux
