#pragma once
// Shows on the terminal what the library does and finds.

#include "app/settings/settings.h"
#include "radiosity/answers/run/run.h"

#include <memory>
#include <string>
#include <vector>

namespace hemilux {

/// Logs a finding, as far as the user wants to see its kind.
void log_finding(Verbosity wanted, const Finding& finding);

/// Returns the sentences of findings.
[[nodiscard]] std::vector<std::string> texts_of(const Findings& findings);

/// Shows stages as long as they last, and logs findings.
class TerminalWatcher : public RunWatcher {
  public:
    explicit TerminalWatcher(Verbosity verbosity) : verbosity_(verbosity) {}

    [[nodiscard]] std::unique_ptr<Watcher::Stage> begin(const std::string& name,
                                                        const std::atomic<double>* share) override;
    void take(const Finding& finding) override { log_finding(verbosity_, finding); }

  private:
    Verbosity verbosity_;
};

} // namespace hemilux
