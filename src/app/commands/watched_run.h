#pragma once
// What `solve` shows, keeps and writes between the steps of a run: the bar, the log, the table of
// steps, pictures, previews and checkpoints.

#include "app/loading/reference.h"
#include "app/outputs/preview.h"
#include "app/outputs/step_pictures.h"
#include "app/outputs/useful_picture.h"
#include "app/report/run_data.h"
#include "app/running/checkpointing.h"
#include "app/terminal/program_watcher.h"
#include "app/terminal/progress.h"
#include "io/results/tables.h"
#include "radiosity/answers/run/run.h"

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hemilux {

/// What is left of the steps of a run.
struct KeptSteps {
    std::vector<StepRow> rows = {};
    std::vector<LightOfStep> lights = {}; ///< light after steps 1, 2, 4 and so on, for a page
    double unit = 1;                      ///< unit of these lights [W/m2]
    WriteReport written = {};             ///< what was written after steps
    std::optional<Camera> camera = {}; ///< view of pictures after steps, which the last one shares
};

/// Watches a run; it refers to its arguments.
class WatchedRun : public RunWatcher {
  public:
    /// Begins to show that a run is made that ends so.
    WatchedRun(const SolveSettings& settings, const Problem& problem, const StopRule& stop,
               Monitor& monitor, const std::optional<Reference>& reference, Preview& preview);

    /// Begins to watch a run, which has steps already where its patches were divided.
    void watch(const Run& run);
    /// Begins to watch a run that goes on after these rows of a checkpoint.
    void watch_resumed(const Run& run, const std::vector<StepRow>& rows);

    [[nodiscard]] std::unique_ptr<Stage> begin(const std::string& name,
                                               const std::atomic<double>* share) override {
        return shown_.begin(name, share);
    }
    void take(const Finding& finding) override { shown_.take(finding); }
    void step_done(const StepRecord& record, const Solution& solution) override;
    [[nodiscard]] bool is_useful(const Solution& solution) override;

    /// Ends it: the bar goes, and what is left to be kept of the run is written.
    [[nodiscard]] KeptSteps finish();

  private:
    void add_row(const StepRecord& record);
    void keep_light(const Solution& solution);
    void show_last_row(const Solution& solution);

    ProgramWatcher shown_;
    const SolveSettings& settings_;
    const Problem& problem_;
    const std::optional<Reference>& reference_;
    Preview& preview_;
    Progress progress_;
    UsefulPicture picture_;
    StepPictures pictures_;
    const Run* run_ = nullptr;
    std::optional<Checkpointer> checkpointer_;
    KeptSteps kept_;
};

} // namespace hemilux
