#pragma once
// --checkpoint and --resume of `viewfactors`: the rows that are measured, so that a run that ended
// is gone on with.

#include "app/running/write_report.h"
#include "app/settings/view_factor_settings.h"
#include "io/results/checkpoint.h"
#include "parallel/stopwatch.h"
#include "radiosity/answers/surfaces/surface_factors.h"

#include <cstdint>
#include <optional>
#include <span>

namespace hemilux {

/// Throws UsageError for what contradicts itself, or keeps no rows.
void check_checkpoint_options(const ViewFactorSettings& settings);

/// Adds the files of --checkpoint and --resume to those of the run.
void check_checkpoint_files(const ViewFactorSettings& settings, RunFiles& files);

/// Reads and writes the rows of one run. It refers to the settings.
class FactorCheckpoint {
  public:
    /// Reads the file of --resume, if there is one. Throws InputError unless it is of a run with
    /// the same options.
    explicit FactorCheckpoint(const ViewFactorSettings& settings);

    /// Makes a scene's rows be read and kept. Throws InputError unless what was read is of this
    /// mesh.
    void attach(FactorScene& scene);
    /// Returns what failed; a checkpoint that is written later makes up for it.
    [[nodiscard]] const WriteReport& report() const { return report_; }

  private:
    void load(std::span<MeasuredRow> rows);
    void keep(std::span<const MeasuredRow> rows, bool is_last);
    [[nodiscard]] bool is_time() const;

    const ViewFactorSettings& settings_;
    std::optional<Checkpoint> resumed_;
    std::uint64_t scene_ = 0;
    double seconds_before_ = 0;
    Stopwatch since_start_, since_written_;
    double seconds_to_write_ = 0;
    std::uint64_t work_written_ = 0; ///< of the rows in the file
    WriteReport report_;
};

} // namespace hemilux
