#pragma once
// --checkpoint and --resume of `solve`: what is kept of a run, and what a run must have in common
// with the one that it continues.

#include "app/running/write_report.h"
#include "app/settings/settings.h"
#include "io/results/checkpoint.h"

#include <chrono>
#include <optional>

namespace hemilux {

/// Throws UsageError for what contradicts itself, or where the method cannot be resumed.
void check_checkpoint_options(const SolveSettings& settings);

/// Returns what --resume names, or empty. Throws InputError unless it is of a run with the same
/// options.
[[nodiscard]] std::optional<Checkpoint> read_resumed(const SolveSettings& settings);

/// Makes the solver go on where the checkpoint was; returns what was done before. Throws InputError
/// unless it is of this scene.
[[nodiscard]] Before resume(const Checkpoint& checkpoint, const SolveSettings& settings,
                            const Mesh& mesh, Solver& solver);

/// This writes the file of --checkpoint at intervals; it does nothing where none is asked for. It
/// refers to the arguments.
class Checkpointer {
  public:
    Checkpointer(const SolveSettings& settings, const Mesh& mesh, const Solver& solver);

    /// Writes if it is time, after a step. `seconds` is the solver's time so far.
    void step_done(const std::vector<StepRow>& rows, double seconds);
    /// Writes at the end, and when interrupted, unless there is nothing new.
    void finish(const std::vector<StepRow>& rows, double seconds);
    /// Returns what failed; a checkpoint that is written later makes up for it.
    [[nodiscard]] const WriteReport& report() const { return report_; }

  private:
    void write(const std::vector<StepRow>& rows, double seconds);

    const SolveSettings& settings_;
    const Solver& solver_;
    std::uint64_t scene_ = 0;
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
    std::optional<std::uint32_t> steps_written_;
    WriteReport report_;
};

} // namespace hemilux
