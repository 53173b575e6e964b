#include "radiosity/answers/run/side_by_side.h"

#include "radiosity/answers/run/step_size.h"

#include <algorithm>
#include <utility>

namespace hemilux {
namespace {

SolveOptions with_step_of(const Budget& budget, SolveOptions options, const Method& method,
                          std::size_t patches) {
    options.rays = rays_of_step(options.rays, budget.seconds, method, patches);
    return options;
}

} // namespace

Budget Budget::with_end(double rays_of_step) const {
    Budget budget = *this;
    const double usual = default_steps * rays_of_step;
    if (budget.error)
        budget.rays = most_for_error * usual;
    else if (!budget.rays && !budget.seconds)
        budget.rays = usual;
    return budget;
}

BudgetedRun::BudgetedRun(const std::shared_ptr<const Problem>& problem, const Method& method,
                         SolveOptions options, const Budget& budget, Monitor& monitor)
    : budget_(budget),
      run_(begin(problem, method,
                 with_step_of(budget, std::move(options), method, problem->mesh->patches().size()),
                 false, monitor)) {}

bool BudgetedRun::step() {
    const double before = used();
    if (!take_step(run_, seconds_left())) {
        cut_short_ = !run_.monitor->interrupted.is_wished();
        return false;
    }
    step_before_ = last_step_;
    last_step_ = used() - before;
    return true;
}

bool BudgetedRun::is_done() const {
    if (cut_short_)
        return true;
    if (run_.steps.empty())
        return false;
    if (budget_.error && *true_error_ <= *budget_.error)
        return true;
    const double growth = step_before_ > 0 ? std::clamp(last_step_ / step_before_, 1.0, 2.0) : 1.0;
    return run_.solver->finished() || used() + growth * last_step_ / 2 > limit();
}

double BudgetedRun::share() const {
    if (is_done())
        return 1;
    if (budget_.error && !run_.steps.empty()) { // rays go as the inverse square of the error
        const double ratio = *budget_.error / *true_error_;
        return std::min(.99, ratio * ratio);
    }
    return std::min(1.0, used() / limit());
}

/// Returns the time limit of a step: it may end as far behind the budget as another would end
/// before it.
std::optional<double> BudgetedRun::seconds_left() const {
    constexpr double least = 1;
    if (!budget_.seconds)
        return std::nullopt;
    return std::max(2 * *budget_.seconds - run_.seconds, least);
}

double BudgetedRun::used() const {
    const Solution& solution = run_.solution();
    return budget_.rays ? static_cast<double>(solution.rays_energy + solution.rays_density)
                        : run_.seconds;
}

void go_on_side_by_side(std::vector<BudgetedRun>& runs, const Monitor& monitor,
                        const std::function<void(std::size_t run)>& after_step) {
    while (!monitor.interrupted && !runs.empty()) {
        const auto least =
            std::ranges::min_element(runs, {}, [](const BudgetedRun& run) { return run.share(); });
        if (least->is_done())
            break;
        if (least->step())
            after_step(static_cast<std::size_t>(least - runs.begin()));
    }
}

} // namespace hemilux
