#include "app/terminal/terminal_watcher.h"

#include "app/terminal/log.h"
#include "app/terminal/stage.h"

namespace hemilux {
namespace {

/// A stage of the terminal as one of the library.
class ShownStage : public Watcher::Stage {
  public:
    ShownStage(const std::string& name, Verbosity verbosity) : shown_(name, verbosity) {}
    ShownStage(const std::string& name, Verbosity verbosity, const std::atomic<double>& share)
        : shown_(name, verbosity, share) {}

  private:
    hemilux::Stage shown_;
};

} // namespace

void log_finding(Verbosity wanted, const Finding& finding) {
    const std::string text = finding.with_advice();
    switch (finding.kind) {
    case Finding::Kind::detail:
        log_line(wanted, Verbosity::verbose, text);
        break;
    case Finding::Kind::note:
        log_line(wanted, Verbosity::normal, text);
        break;
    case Finding::Kind::warning:
        log_line(wanted, Verbosity::normal, "warning: " + text);
        break;
    case Finding::Kind::ended_early:
        log_line(wanted, Verbosity::quiet, text);
        break;
    }
}

std::vector<std::string> texts_of(const Findings& findings) {
    std::vector<std::string> texts;
    for (const Finding& finding : findings)
        texts.push_back(finding.with_advice());
    return texts;
}

std::unique_ptr<Watcher::Stage> TerminalWatcher::begin(const std::string& name,
                                                       const std::atomic<double>* share) {
    if (share)
        return std::make_unique<ShownStage>(name, verbosity_, *share);
    return std::make_unique<ShownStage>(name, verbosity_);
}

} // namespace hemilux
