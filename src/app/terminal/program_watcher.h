#pragma once
// How the program follows work: its stages are lines that live on a terminal, and what there is to
// say is logged.

#include "app/settings/settings.h"
#include "radiosity/answers/asked/watcher.h"

#include <atomic>
#include <memory>
#include <string>
#include <vector>

namespace hemilux {

/// Logs a finding as far as the user wants to see it.
void log_finding(Verbosity wanted, const Finding& finding);
/// Returns the sentences of findings.
[[nodiscard]] std::vector<std::string> texts_of(const Findings& findings);

class ProgramWatcher : public Watcher {
  public:
    explicit ProgramWatcher(Verbosity verbosity) : verbosity_(verbosity) {}
    [[nodiscard]] std::unique_ptr<Stage> begin(const std::string& name,
                                               const std::atomic<double>* share) override;
    void take(const Finding& finding) override { log_finding(verbosity_, finding); }

  private:
    Verbosity verbosity_;
};

} // namespace hemilux
