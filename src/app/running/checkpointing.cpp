#include "app/running/checkpointing.h"

#include "app/running/same_run.h"
#include "app/settings/exit_code.h"
#include "app/settings/method_options.h"
#include "app/settings/numbers.h"
#include "app/terminal/log.h"
#include "io/files/error.h"
#include "radiosity/engine/saving/state.h"
#include "radiosity/engine/solving/engine_solver.h"
#include "radiosity/engine/solving/method_option.h"

#include <algorithm>

namespace hemilux {

namespace {

std::string yes_or_no(bool value) { return value ? "yes" : "no"; }

/// Returns all options but those that decide when to stop, where to write and how many threads
/// work. What changes the scene is in its hash.
CheckpointOptions options_of(const SolveSettings& settings) {
    const SolveOptions& o = settings.options;
    CheckpointOptions options = {{"hemilux", HEMILUX_VERSION},
                                 {"--method", std::string(settings.method->name)},
                                 {"--rays", shortest_text(o.rays)},
                                 {"--depth", std::to_string(o.depth)},
                                 {"--threshold", shortest_text(o.threshold)},
                                 {"--seed", std::to_string(o.seed)},
                                 {"--literal", yes_or_no(o.literal)},
                                 {"--keep-all", yes_or_no(o.keep_all)}};
    for (const MethodOption& option : settings.method->own_options())
        if (option.resumable)
            options.emplace_back(option.name, option.get(o));
    for (const std::string& name : settings.target.names())
        options.emplace_back("--for " + name, "yes");
    return options;
}

/// Returns the default value of an option of some method, which need not be named where it has this
/// value; else empty.
std::string default_of(const std::string& name) {
    for (const Method* const method : methods())
        for (const MethodOption& own : method->own_options())
            if (own.name == name)
                return own.get({});
    return {};
}

} // namespace

void check_checkpoint_options(const SolveSettings& settings) {
    if (!uses_checkpoint(settings.checkpoint))
        return;
    if (!settings.method->can_resume())
        throw UsageError(
            "--checkpoint and --resume: --method " + std::string(settings.method->name) +
            " does not keep its state; these do: " +
            names_of_methods([](const Method& method) { return method.can_resume(); }));
    for (const MethodOption& option : settings.method->own_options())
        if (!option.resumable && option.is_set(settings.options))
            throw UsageError("--checkpoint and --resume: a run with " +
                             option.text(settings.options) + " does not keep its state");
    if (!settings.checkpoint.resumed.empty() && settings.every_step &&
        !(settings.view.camera && settings.view.exposure))
        throw UsageError("--every-step after --resume needs --camera and --exposure, which the "
                         "first step would choose");
}

std::optional<Checkpoint> read_resumed(const SolveSettings& settings) {
    const std::string& path = settings.checkpoint.resumed;
    if (path.empty())
        return std::nullopt;
    Checkpoint checkpoint = read_checkpoint(path);
    check_same_run(checkpoint.options, options_of(settings), path, default_of);
    return checkpoint;
}

Before resume(const Checkpoint& checkpoint, const SolveSettings& settings, const Mesh& mesh,
              Solver& solver) {
    const std::string& path = settings.checkpoint.resumed;
    check_same_scene(checkpoint.scene, scene_hash(mesh), path, settings.scene.path);
    const double density_now = solver.solution().seconds_density;
    try {
        StateReader state(checkpoint.state);
        dynamic_cast<EngineSolver&>(solver).load(state); // pages are refused before
        state.expect_end();
    } catch (const StateError& error) {
        throw InputError(path, std::string("is a damaged checkpoint: ") + error.what());
    }
    if (checkpoint.rows.size() != solver.solution().steps)
        throw InputError(path, "is a damaged checkpoint: expected a row for each step");
    for (std::size_t k = 0; k < checkpoint.rows.size(); ++k)
        if (checkpoint.rows[k].record.step != k + 1 ||
            checkpoint.rows[k].method != settings.method->name)
            throw InputError(path, "is a damaged checkpoint: a row is not of its step");
    const double density_before = solver.solution().seconds_density - density_now;
    return {solver.solution().steps, checkpoint.seconds - density_before};
}

Checkpointer::Checkpointer(const SolveSettings& settings, const Mesh& mesh, const Solver& solver)
    : settings_(settings), solver_(solver) {
    if (!settings.checkpoint.path.empty())
        scene_ = scene_hash(mesh);
}

void Checkpointer::step_done(const std::vector<StepRow>& rows, double seconds) {
    const std::chrono::duration<double> since = std::chrono::steady_clock::now() - last_;
    if (settings_.ranks->any(since.count() >= settings_.checkpoint.every.value_or(
                                                  CheckpointSettings::default_every)))
        write(rows, seconds);
}

void Checkpointer::finish(const std::vector<StepRow>& rows, double seconds) {
    if (steps_written_.value_or(0) != solver_.solution().steps)
        write(rows, seconds);
}

void Checkpointer::write(const std::vector<StepRow>& rows, double seconds) {
    const std::string& path = settings_.checkpoint.path;
    if (path.empty())
        return;
    const bool first_failure = report_.failed.empty();
    report_ = {};
    report_.attempt(path, [&] {
        StateWriter state;
        dynamic_cast<const EngineSolver&>(solver_).save(state);
        write_checkpoint(path,
                         {options_of(settings_), scene_, seconds, rows, std::move(state).bytes()});
    });
    last_ = std::chrono::steady_clock::now();
    if (settings_.ranks->all(!report_.written.empty()))
        steps_written_ = solver_.solution().steps;
    else if (first_failure && !report_.failed.empty())
        log_line(settings_.verbosity, Verbosity::normal, "warning: " + report_.failed.front());
}

} // namespace hemilux
