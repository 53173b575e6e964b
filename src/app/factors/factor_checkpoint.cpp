#include "app/factors/factor_checkpoint.h"

#include "app/running/same_run.h"
#include "app/settings/exit_code.h"
#include "app/settings/factor_aim.h"
#include "app/settings/numbers.h"
#include "app/terminal/log.h"
#include "io/files/atomic_file.h"
#include "io/files/error.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/engine/saving/state.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <array>

namespace hemilux {
namespace {

/// Returns the options that rows depend on. What changes the shapes is in the hash of the scene.
CheckpointOptions options_of(const ViewFactorSettings& settings) {
    CheckpointOptions options = {{"hemilux", HEMILUX_VERSION},
                                 {"command", "viewfactors"},
                                 {"--rays", std::to_string(settings.rays)},
                                 {"--seed", std::to_string(settings.options.seed)},
                                 {"--error", shortest_text(settings.error)},
                                 {"--of", text_of(settings.aim)}};
    if (settings.aim.of == FactorAim::Of::pair) {
        constexpr std::array names = {"face", "group", "material", "patch"};
        options.emplace_back("--by", names[static_cast<std::size_t>(settings.by)]);
    }
    return options;
}

/// Returns a number that grows as rows are measured.
std::uint64_t work_of(std::span<const MeasuredRow> rows) {
    std::uint64_t work = 0;
    for (const MeasuredRow& row : rows)
        work += row.is_measured() ? row.work.rays + row.work.lines + 1 : 0;
    return work;
}

} // namespace

void check_checkpoint_options(const ViewFactorSettings& settings) {
    if (!uses_checkpoint(settings.checkpoint))
        return;
    if (settings.aim.of == FactorAim::Of::sky || settings.aim.of == FactorAim::Of::largest)
        throw UsageError("--checkpoint and --resume: --of " + text_of(settings.aim) +
                         " keeps no rows; above:F, rows and pair:A,B do");
    if (settings.outputs.empty() && settings.heat.output.empty())
        throw UsageError("--checkpoint and --resume keep factors; name a file for them by "
                         "--output");
}

void check_checkpoint_files(const ViewFactorSettings& settings, RunFiles& files) {
    if (const std::string& path = settings.checkpoint.path; !path.empty()) {
        files.write("checkpoint", path);
        check_writable(path);
    }
    read_resumed_file(settings.checkpoint, files);
}

FactorCheckpoint::FactorCheckpoint(const ViewFactorSettings& settings) : settings_(settings) {
    const std::string& path = settings.checkpoint.resumed;
    if (path.empty())
        return;
    resumed_ = read_checkpoint(path);
    check_same_run(resumed_->options, options_of(settings), path);
    seconds_before_ = resumed_->seconds;
}

void FactorCheckpoint::attach(FactorScene& scene) {
    if (resumed_ || !settings_.checkpoint.path.empty())
        scene_ = scene_hash(scene.mesh);
    if (resumed_) {
        check_same_scene(resumed_->scene, scene_, settings_.checkpoint.resumed,
                         settings_.scene.path);
        scene.load = [this](std::span<MeasuredRow> rows) { load(rows); };
    }
    if (!settings_.checkpoint.path.empty())
        scene.keep = [this](std::span<const MeasuredRow> rows, bool is_last) {
            keep(rows, is_last);
        };
}

void FactorCheckpoint::load(std::span<MeasuredRow> rows) {
    try {
        StateReader state(resumed_->state);
        load_rows(state, rows);
        state.expect_end();
    } catch (const StateError& error) {
        throw InputError(settings_.checkpoint.resumed,
                         std::string("is a damaged checkpoint: ") + error.what());
    }
    resumed_.reset();
    const auto measured = std::ranges::count_if(rows, &MeasuredRow::is_measured);
    log_line(settings_.verbosity, Verbosity::normal,
             "resumed: " + grouped(static_cast<std::uint64_t>(measured)) + " of " +
                 counted(rows.size(), "patch", "patches") + " were measured in " +
                 duration(seconds_before_));
    if (settings_.checkpoint.resumed == settings_.checkpoint.path)
        work_written_ = work_of(rows);
}

/// Large checkpoints take a while to write. Unless --every says so, no more than a tenth of the
/// time goes to them.
bool FactorCheckpoint::is_time() const {
    constexpr double share = .1;
    const double since = since_written_.seconds();
    return settings_.checkpoint.every
               ? since >= *settings_.checkpoint.every
               : since >= std::max(CheckpointSettings::default_every, seconds_to_write_ / share);
}

void FactorCheckpoint::keep(std::span<const MeasuredRow> rows, bool is_last) {
    if (!is_last && !is_time())
        return;
    const std::uint64_t work = work_of(rows);
    if (work == work_written_)
        return;
    const std::string& path = settings_.checkpoint.path;
    const bool is_first_failure = report_.failed.empty();
    const Stopwatch watch;
    report_ = {};
    report_.attempt(path, [&] {
        StateWriter state;
        save_rows(rows, state);
        write_checkpoint(path, {.options = options_of(settings_),
                                .scene = scene_,
                                .seconds = seconds_before_ + since_start_.seconds(),
                                .rows = {},
                                .state = std::move(state).bytes()});
    });
    since_written_ = {};
    seconds_to_write_ = watch.seconds();
    if (report_.failed.empty())
        work_written_ = work;
    else if (is_first_failure)
        log_line(settings_.verbosity, Verbosity::normal, "warning: " + report_.failed.front());
}

} // namespace hemilux
