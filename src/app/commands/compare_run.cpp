#include "app/commands/compare_run.h"

#include <bit>

namespace hemilux {

namespace {

/// Returns the options of a run of a variant.
SolveOptions options_of(const Comparison& comparison, const MethodVariant& variant,
                        std::uint32_t run) {
    const CompareSettings& settings = comparison.settings;
    SolveOptions options = settings.options;
    options.memory = memory_of_solver({.limit = settings.scene.memory,
                                       .needed = comparison.bytes_needed,
                                       .solvers = settings.variants.size()});
    options = variant.applied_to(std::move(options));
    options.seed += run;
    options.literal = options.literal && variant.method->has_literal;
    return options;
}

/// A run of all variants, each until its budget is used up or all are interrupted.
class OnceAll {
  public:
    OnceAll(const Comparison& comparison, std::uint32_t number)
        : comparison_(comparison), number_(number) {}

    /// Takes all steps. What was done remains when one cannot be done.
    void go_on(const std::function<void(const StepRow&, double share)>& after_step) {
        const std::vector<MethodVariant>& variants = comparison_.settings.variants;
        const Budget budget = comparison_.settings.budget.with_end(
            comparison_.settings.options.rays *
            static_cast<double>(comparison_.mesh.patches().size()));
        for (const MethodVariant& variant : variants) {
            if (comparison_.monitor.interrupted)
                return;
            runs_.emplace_back(comparison_.problem, *variant.method,
                               options_of(comparison_, variant, number_), budget,
                               comparison_.monitor);
            results_.emplace_back();
        }
        go_on_side_by_side(runs_, comparison_.monitor, [&](std::size_t at) {
            add_row(at);
            after_step(results_[at].rows.back(), mean_share());
        });
    }
    [[nodiscard]] std::size_t begun() const { return runs_.size(); }
    [[nodiscard]] const std::vector<Vec3>& radiosity(std::size_t at) const {
        return runs_[at].run().solution().radiosity;
    }
    [[nodiscard]] MethodRun result(std::size_t at) {
        MethodRun& result = results_[at];
        if (!result.rows.empty() && !std::has_single_bit(result.rows.size()))
            keep_light(at);
        result.bytes_density = runs_[at].run().solution().bytes_density;
        result.complete = runs_[at].is_done();
        return std::move(result);
    }

  private:
    /// Adds the last step of a run, with its true error.
    void add_row(std::size_t at) {
        const Run& run = runs_[at].run();
        const std::vector<Vec3>& radiosity = run.solution().radiosity;
        StepRow row{comparison_.settings.variants[at].name,
                    number_,
                    run.steps.back(),
                    comparison_.reference.error(comparison_.mesh, radiosity),
                    std::nullopt,
                    std::nullopt};
        if (comparison_.light)
            row.total_error = comparison_.light->error(radiosity);
        if (comparison_.settings.relative_mse)
            row.relative_mse = comparison_.reference.relative_mse(comparison_.mesh, radiosity);
        runs_[at].judge(row.total_error.value_or(row.error->all)); // of what the curves show
        results_[at].rows.push_back(std::move(row));
        if (std::has_single_bit(results_[at].rows.size()))
            keep_light(at);
    }
    void keep_light(std::size_t at) {
        if (number_ == 0 && !comparison_.settings.report.empty())
            results_[at].lights.push_back(
                {results_[at].rows.back().record.step, halves_of(radiosity(at), comparison_.unit)});
    }
    [[nodiscard]] double mean_share() const {
        double sum = 0;
        for (const BudgetedRun& run : runs_)
            sum += run.share();
        return sum / static_cast<double>(comparison_.settings.variants.size());
    }

    const Comparison& comparison_;
    std::uint32_t number_;
    std::vector<BudgetedRun> runs_;
    std::vector<MethodRun> results_; ///< by run
};

} // namespace

std::vector<MethodRuns>
run_methods(const Comparison& comparison, std::optional<SolveError>& fault,
            const std::function<void(const StepRow&, double share)>& after_step) {
    std::vector<MethodRuns> results;
    for (const MethodVariant& variant : comparison.settings.variants)
        results.push_back({variant, {}, {}});
    const std::uint32_t runs = comparison.settings.runs;
    for (std::uint32_t run = 0; run < runs && !comparison.monitor.interrupted && !fault; ++run) {
        OnceAll all(comparison, run);
        try {
            all.go_on(
                [&](const StepRow& row, double share) { after_step(row, (run + share) / runs); });
        } catch (const SolveError& error) {
            fault = error;
        }
        for (std::size_t m = 0; m < all.begun(); ++m) {
            results[m].runs.push_back(all.result(m));
            if (results[m].radiosity.empty() && !results[m].runs.back().rows.empty())
                results[m].radiosity = all.radiosity(m);
        }
    }
    return results;
}

} // namespace hemilux
