#include "app/commands/watched_run.h"

#include "app/report/half_light.h"
#include "app/terminal/log.h"
#include "app/terminal/summary.h"
#include "radiosity/answers/asked/text.h"

#include <bit>
#include <string>
#include <utility>

namespace hemilux {

WatchedRun::WatchedRun(const SolveSettings& settings, const Problem& problem, const StopRule& stop,
                       Monitor& monitor, const std::optional<Reference>& reference,
                       Preview& preview)
    : shown_(settings.verbosity), settings_(settings), problem_(problem), reference_(reference),
      preview_(preview), progress_(monitor, share_of(stop, *settings.method),
                                   settings.verbosity != Verbosity::quiet && stderr_is_terminal()),
      picture_(settings, *problem.mesh, *problem.tracer),
      pictures_(settings, *problem.mesh, *problem.tracer, monitor.interrupted.own().wished) {}

void WatchedRun::watch(const Run& run) {
    run_ = &run;
    checkpointer_.emplace(settings_, *problem_.mesh, *run.solver);
    for (const StepRecord& record : run.steps)
        add_row(record);
    if (!run.steps.empty())
        show_last_row(run.solution());
}

void WatchedRun::watch_resumed(const Run& run, const std::vector<StepRow>& rows) {
    run_ = &run;
    checkpointer_.emplace(settings_, *problem_.mesh, *run.solver);
    kept_.rows = rows;
}

void WatchedRun::step_done(const StepRecord& record, const Solution& solution) {
    add_row(record);
    keep_light(solution);
    show_last_row(solution);
    checkpointer_->step_done(kept_.rows, record.seconds);
}

bool WatchedRun::is_useful(const Solution& solution) {
    if (!settings_.useful)
        return false;
    const double similarity = picture_.similarity(solution);
    tell(Finding::Kind::detail,
         formatted("picture: similarity of %.4f to one without noise", similarity));
    return similarity >= UsefulPicture::useful;
}

void WatchedRun::add_row(const StepRecord& record) {
    kept_.rows.push_back({std::string(settings_.method->name), 0, record, std::nullopt});
    progress_.step_done(record);
}

void WatchedRun::keep_light(const Solution& solution) {
    if (settings_.report.empty() || !std::has_single_bit(solution.steps))
        return;
    if (kept_.lights.empty())
        kept_.unit = mean_light(*problem_.mesh, solution.radiosity);
    kept_.lights.push_back({solution.steps, halves_of(solution.radiosity, kept_.unit)});
}

void WatchedRun::show_last_row(const Solution& solution) {
    const Mesh& mesh = *problem_.mesh;
    if (reference_)
        kept_.rows.back().error = reference_->error(mesh, solution.radiosity);
    pictures_.write(solution.radiosity, solution.steps);
    tell(Finding::Kind::detail, step_text(kept_.rows.back()));
    preview_.show({mesh, *problem_.tracer, solution.radiosity, settings_.options.threads},
                  solution);
}

KeptSteps WatchedRun::finish() {
    progress_.close();
    checkpointer_->finish(kept_.rows, run_->seconds);
    kept_.written = pictures_.report();
    kept_.written.add(checkpointer_->report());
    kept_.camera = pictures_.camera();
    return std::move(kept_);
}

} // namespace hemilux
