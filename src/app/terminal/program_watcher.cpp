#include "app/terminal/program_watcher.h"

#include "app/terminal/log.h"
#include "app/terminal/stage.h"

namespace hemilux {
namespace {

struct ShownStage final : Watcher::Stage {
    ShownStage(const std::string& name, Verbosity verbosity, const std::atomic<double>* share)
        : stage(share ? hemilux::Stage(name, verbosity, *share) : hemilux::Stage(name, verbosity)) {
    }
    hemilux::Stage stage;
};

Verbosity verbosity_of(Finding::Kind kind) {
    switch (kind) {
    case Finding::Kind::detail:
        return Verbosity::verbose;
    case Finding::Kind::note:
    case Finding::Kind::warning:
        return Verbosity::normal;
    case Finding::Kind::ended_early:
        break;
    }
    return Verbosity::quiet;
}

} // namespace

void log_finding(Verbosity wanted, const Finding& finding) {
    const std::string mark = finding.kind == Finding::Kind::warning ? "warning: " : "";
    log_line(wanted, verbosity_of(finding.kind), mark + finding.with_advice());
}

std::vector<std::string> texts_of(const Findings& findings) {
    std::vector<std::string> texts;
    for (const Finding& finding : findings)
        texts.push_back(finding.with_advice());
    return texts;
}

std::unique_ptr<Watcher::Stage> ProgramWatcher::begin(const std::string& name,
                                                      const std::atomic<double>* share) {
    return std::make_unique<ShownStage>(name, verbosity_, share);
}

} // namespace hemilux
