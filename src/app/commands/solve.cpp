// hemilux solve: read, divide, build, run, write.

#include "app/commands/commands.h"
#include "app/commands/solve_end.h"
#include "app/division/auto_division.h"
#include "app/division/default_division.h"
#include "app/division/whole_error.h"
#include "app/loading/load.h"
#include "app/loading/reference.h"
#include "app/memory/memory.h"
#include "app/rendering/view.h"
#include "app/running/checkpointing.h"
#include "app/running/point_table.h"
#include "app/running/run_files.h"
#include "app/running/run_notes.h"
#include "app/running/signals.h"
#include "app/running/step_pictures.h"
#include "app/running/step_size.h"
#include "app/running/target_weights.h"
#include "app/settings/exit_code.h"
#include "app/settings/method_options.h"
#include "app/settings/text.h"
#include "app/terminal/log.h"
#include "app/terminal/progress.h"
#include "app/terminal/stopwatch.h"
#include "app/terminal/summary.h"
#include "app/terminal/unused_options.h"
#include "io/results/points.h"
#include "parallel/workers.h"
#include "radiosity/engine/needs/find_needs.h"
#include "radiosity/engine/solving/left_out.h"
#include "radiosity/engine/solving/shared_stop.h"

#include <algorithm>
#include <span>

namespace hemilux {

namespace {

/// Returns the stop rule. `sampling` is the error that --divide auto leaves to the run, where that
/// is known.
StopRule stop_rule(const SolveSettings& settings, std::size_t patches,
                   std::optional<double> sampling = {}) {
    StopRule stop = settings.stop;
    if (settings.divide_auto && (stop.error || (!stop.steps && !stop.seconds)))
        stop.error = sampling.value_or(share_of_sampling * whole_error(settings));
    if (!stop.steps && !stop.seconds && !stop.error) {
        stop = settings.method->default_stop;
        stop.rays = settings.stop.rays;
        if (settings.work().ends_by_itself)
            stop.steps.reset();
        else if (!stop.steps && !stop.seconds && !stop.error)
            stop.steps = StopRule::default_steps;
    }
    if (!stop.steps && !stop.seconds && !stop.rays && settings.work().estimates_error)
        stop.rays = default_max_rays(patches);
    return stop;
}

/// A run of the program from its options to its last words, step by step.
class SolveRun {
  public:
    explicit SolveRun(const SolveSettings& settings)
        : settings_(settings), options_(with_memory(settings.options, settings.scene)) {}

    void read_scene();
    void build_tree();
    void divide();
    void read_the_reference();
    void take_steps();
    void estimate_errors();
    /// Returns the exit code.
    [[nodiscard]] int write();

  private:
    [[nodiscard]] const Mesh& mesh() const { return loaded_->mesh; }
    [[nodiscard]] const Tracer& tracer() const { return *prepared_->made.tracer; }
    [[nodiscard]] InputError as_input_error(const SolveError& error) const {
        return hemilux::as_input_error(error, settings_.scene.path, loaded_->face_lines);
    }
    [[nodiscard]] bool has_pictures() const {
        return std::ranges::any_of(settings_.outputs, is_picture, &Output::kind) ||
               !settings_.error_map.empty();
    }
    [[nodiscard]] double bytes_of_outputs() const;
    [[nodiscard]] std::unique_ptr<Solver> begin();
    void mesh_changed();

    SolveSettings settings_; ///< with the camera of the scene, where none was given
    const Stopwatch started_;
    Monitor monitor_;
    std::optional<SharedStop> shared_stop_; ///< of the ranks
    InterruptGuard guard_;
    Statistics statistics_;
    SolveOptions options_;
    std::optional<Checkpoint> resumed_;
    std::vector<NamedPoint> points_;
    std::vector<TargetPoints> target_points_;
    std::vector<double> target_; ///< SolverInput::target
    std::optional<LoadedMesh> loaded_;
    std::optional<Prepared> prepared_;
    std::optional<SolverInput> input_;
    Divided divided_;
    std::optional<Reference> reference_;
    std::unique_ptr<Solver> solver_;
    std::vector<StepRow> rows_;
    std::optional<RunNotes> notes_;
    std::optional<Camera> camera_; ///< of pictures after steps, which the last one shares
    WriteReport of_steps_;
    std::optional<InputError> fault_; ///< in a step; those before it are written
    bool completed_ = false;
    double seconds_solver_ = 0;
    std::optional<Solution> linear_;     ///< with slopes
    const Solution* solution_ = nullptr; ///< that is written
};

void SolveRun::read_scene() {
    const RunFiles files = check_files(settings_);
    const std::span methods(&settings_.method, 1);
    check_own_options(settings_.options, methods);
    check_plain(settings_);
    check_target(settings_);
    check_checkpoint_options(settings_);
    warn_of_unused(settings_);
    Workers(settings_.options.threads).start();
    resumed_ = read_resumed(settings_);
    if (!settings_.points.path.empty())
        points_ = read_points(settings_.points.path);
    target_points_ = points_of_target(settings_.target);
    loaded_ = load_mesh(settings_.scene, files, settings_.options, methods, settings_.verbosity,
                        bytes_of_outputs());
    settings_.divide_auto |= divides_by_default(settings_, mesh().patches().size());
    check_distances(settings_, points_, mesh());
    settings_.view = view_of(settings_.view, loaded_->view,
                             has_pictures() || !settings_.report.empty() ? settings_.verbosity
                                                                         : Verbosity::quiet);
    check_camera(settings_.view, mesh());
    check_own_options(settings_.options, methods, mesh().patches().size());
    check_plain(settings_, mesh().patches().size());
    statistics_.seconds_read = loaded_->seconds_read;
}

double SolveRun::bytes_of_outputs() const {
    return (has_pictures() ? bytes_of_picture(settings_.view.size, settings_.gather_pictures) : 0) +
           bytes_of_points(points_.size(), settings_.gather) +
           bytes_of_lightmap(settings_.lightmap.value_or(0));
}

void SolveRun::build_tree() {
    prepared_ = prepare(*loaded_, settings_.options, settings_.verbosity);
    statistics_.seconds_bvh = prepared_->seconds;
    log_line(settings_.verbosity, Verbosity::verbose,
             tracer_text(prepared_->made.tree, statistics_.seconds_bvh));
    target_ = target_weights(settings_, target_points_, mesh(), tracer());
    input_.emplace(SolverInput{mesh(), tracer(), options_, monitor_, prepared_->needs, target_});
    shared_stop_.emplace(monitor_.interrupted, *settings_.ranks);
    guard_.watch(monitor_.interrupted.own().wished);
}

/// Begins a solver for the mesh as it is then.
std::unique_ptr<Solver> SolveRun::begin() {
    const std::size_t patches = mesh().patches().size();
    const StopRule stop = stop_rule(settings_, patches);
    options_.rays =
        rays_of_step(settings_.options.rays, settings_.stop.seconds, *settings_.method, patches);
    options_.stop = stop;
    try {
        const Method& method = *settings_.method;
        return settings_.plain ? method.plain(*input_) : method.make(*input_);
    } catch (const SolveError& error) {
        throw as_input_error(error);
    }
}

void SolveRun::mesh_changed() {
    if (!settings_.options.keep_all)
        prepared_->needs = find_needs(mesh());
    target_ = target_weights(settings_, target_points_, mesh(), tracer());
    input_->target = target_;
}

/// Divides the mesh where --divide auto asks for it.
void SolveRun::divide() {
    try {
        divided_ = divide_as_asked(
            settings_, loaded_->mesh, *input_, [&] { return begin(); }, [&] { mesh_changed(); },
            statistics_);
    } catch (const SolveError& error) {
        throw as_input_error(error);
    }
}

/// Reads the reference, which is of the patches as they are divided. A signal ends the program
/// while the file is read.
void SolveRun::read_the_reference() {
    std::vector<bool> detail = detail_mask(mesh(), settings_.detail);
    if (settings_.reference.empty() || monitor_.interrupted)
        return;
    guard_.unwatch();
    reference_ = read_reference(settings_.reference, mesh(), std::move(detail));
    guard_.watch(monitor_.interrupted.own().wished);
}

void SolveRun::take_steps() {
    const StopRule stop = stop_rule(settings_, mesh().patches().size(), divided_.sampling);
    Progress progress(monitor_, share_of(stop, *settings_.method),
                      settings_.verbosity != Verbosity::quiet && stderr_is_terminal());
    const Stopwatch solving;
    const bool is_begun = divided_.begun && !resumed_;
    solver_ = is_begun ? std::move(divided_.begun) : begin();
    log_rays_of_step(settings_.verbosity, settings_.options.rays, options_.rays);
    Before before = divided_.before();
    before.seconds += statistics_.seconds_divide; // a time limit is of both
    if (resumed_) {
        before = resume(*resumed_, settings_, mesh(), *solver_);
        rows_ = resumed_->rows;
    }
    Checkpointer checkpointer(settings_, mesh(), *solver_);
    StepPictures step_pictures(settings_, mesh(), tracer(), monitor_.interrupted.own().wished);
    notes_.emplace(stop, settings_.work().estimates_error);
    const auto add_row = [&](const StepRecord& record) {
        notes_->step_done(record);
        rows_.push_back({std::string(settings_.method->name), 0, record, std::nullopt});
        progress.step_done(record);
    };
    const auto show_last_row = [&](const Solution& solution) {
        if (reference_)
            rows_.back().error = reference_->error(mesh(), solution.radiosity);
        if (settings_.every_step)
            step_pictures.write(solution.radiosity, solution.steps);
        if (settings_.verbosity == Verbosity::verbose)
            progress.log(step_text(rows_.back()));
    };
    const auto after_step = [&](const StepRecord& record, const Solution& solution) {
        add_row(record);
        show_last_row(solution);
        checkpointer.step_done(rows_, record.seconds);
    };
    if (is_begun && !divided_.steps.empty()) {
        for (StepRecord record : divided_.steps) {
            record.seconds += statistics_.seconds_divide;
            add_row(record);
        }
        show_last_row(solver_->solution());
    }
    try {
        completed_ = run(*solver_, *input_, stop, after_step, before);
    } catch (const SolveError& error) {
        fault_ = as_input_error(error);
        if (solver_->solution().steps == 0)
            throw *fault_;
    }
    seconds_solver_ =
        solving.seconds() + (resumed_ ? resumed_->seconds : divided_.before().seconds);
    progress.close();
    checkpointer.finish(rows_, seconds_solver_);
    of_steps_ = step_pictures.report();
    of_steps_.add(checkpointer.report());
    camera_ = step_pictures.camera();
}

void SolveRun::estimate_errors() {
    // Where a signal or the time left no step, the light by which patches were divided is used.
    const bool has_step = solver_->solution().steps > 0 || divided_.rough.steps == 0;
    solution_ = has_step ? &solver_->solution() : &divided_.rough;
    if (divided_.linear) {
        linear_ = *solution_;
        linear_->slope = divided_.slope;
        solution_ = &*linear_;
    }
    fill(statistics_, settings_, mesh(), *solution_, seconds_solver_);
    // Without an estimate of sampling, the error of the division would be taken for the whole.
    if (!settings_.work().estimates_error || !shows_statistics(settings_))
        statistics_.error_sampling = statistics_.estimated_error;
    else
        add_division_error(statistics_, settings_, mesh(), tracer(), *solution_, divided_,
                           monitor_.interrupted);
    if (!settings_.plain) // which leaves out nothing
        statistics_.left_out = left_out(prepared_->needs, settings_.work(), *solution_);
    statistics_.bytes_peak = peak_memory_bytes();
    if (settings_.ranks->are_several())
        statistics_.ranks =
            settings_.ranks->of_each(RankFigures{settings_.ranks->work(), statistics_.bytes_peak});
}

int SolveRun::write() {
    if (!settings_.ranks->is_first()) // whose result is the first one's
        return exit_done;
    const OnThisRank works_alone(monitor_.interrupted);
    const bool interrupted = !completed_ && !fault_;
    SolveSettings shown = settings_;
    shown.view.camera = camera_;
    const int code = finish(
        shown,
        {mesh(), tracer(), *solution_, statistics_, rows_, points_, loaded_->warnings, monitor_},
        of_steps_, reference_, *notes_, interrupted, started_, resumed_ ? resumed_->seconds : 0);
    if (interrupted && !settings_.ranks->are_several())
        end_at_once(code);
    if (!fault_ || code != exit_done)
        return code;
    log_line(settings_.verbosity, Verbosity::quiet,
             std::string("hemilux: ") + fault_->what() + "\nthe outputs hold " +
                 counted(solver_->solution().steps, "step", "steps") + " before that");
    return exit_input;
}

} // namespace

int solve(const SolveSettings& settings) {
    SolveRun run(settings);
    run.read_scene();
    run.build_tree();
    run.divide();
    run.read_the_reference();
    run.take_steps();
    run.estimate_errors();
    return run.write();
}

} // namespace hemilux
