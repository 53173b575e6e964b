// hemilux solve: load, build, divide, take steps, write.

#include "app/commands/commands.h"
#include "app/commands/solve_end.h"
#include "app/division/auto_division.h"
#include "app/division/default_division.h"
#include "app/division/whole_error.h"
#include "app/gathering/gathered_light.h"
#include "app/gathering/lightmap_layout.h"
#include "app/gathering/point_table.h"
#include "app/gathering/shown_camera.h"
#include "app/lamps/lamp_light.h"
#include "app/loading/load.h"
#include "app/loading/reference.h"
#include "app/memory/memory.h"
#include "app/outputs/lit_preview.h"
#include "app/outputs/preview.h"
#include "app/outputs/step_pictures.h"
#include "app/outputs/useful_picture.h"
#include "app/rendering/view.h"
#include "app/report/half_light.h"
#include "app/running/checkpointing.h"
#include "app/running/run_files.h"
#include "app/running/run_notes.h"
#include "app/running/signals.h"
#include "app/running/step_size.h"
#include "app/running/target_weights.h"
#include "app/settings/exit_code.h"
#include "app/settings/method_options.h"
#include "app/terminal/log.h"
#include "app/terminal/program_watcher.h"
#include "app/terminal/progress.h"
#include "app/terminal/stage.h"
#include "app/terminal/summary.h"
#include "app/terminal/unused_options.h"
#include "io/results/points.h"
#include "parallel/stopwatch.h"
#include "parallel/workers.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/answers/charts/charts.h"
#include "radiosity/answers/gathering/light_of_patches.h"
#include "radiosity/engine/emitters/lit_by_points.h"
#include "radiosity/engine/needs/find_needs.h"
#include "radiosity/engine/solving/left_out.h"
#include "radiosity/engine/solving/shared_stop.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <span>

namespace hemilux {

namespace {

/// All that a run reads before it builds anything.
struct Loaded {
    SolveSettings settings; ///< options with the camera of the scene, where none was given
    std::optional<Checkpoint> resumed;
    std::vector<NamedPoint> points;          ///< points of --points
    std::vector<TargetPoints> target_points; ///< points of --for
    PatchTable reference;                    ///< table of --reference
    LoadedMesh scene;
    FileLightmap file_lightmap; ///< of `bake`
};

/// What a solver refers to; it stays where it is while one lives.
struct Problem {
    Loaded loaded;
    Monitor& monitor; ///< the caller's
    Prepared prepared = {};
    std::vector<double> target = {}; ///< SolverInput::target
    SolveOptions options = {};       ///< options with the rays of a step and the end of the run

    [[nodiscard]] const SolveSettings& settings() const { return loaded.settings; }
    [[nodiscard]] const Mesh& mesh() const { return loaded.scene.mesh; }
    [[nodiscard]] const Tracer& tracer() const { return *prepared.made.tracer; }
    [[nodiscard]] SolverInput input() const {
        return {mesh(), tracer(), options, monitor, prepared.needs, target};
    }
};

/// A run whose steps are done.
struct Run {
    std::unique_ptr<Solver> solver;
    std::vector<StepRow> rows;
    std::vector<LightOfStep> lights; ///< light after steps 1, 2, 4 and so on, for a page
    double unit = 1;                 ///< unit of these lights [W/m2]
    RunNotes notes;
    std::optional<InputError> fault = {}; ///< fault in a step; the steps before it are written
    bool completed = false;
    double seconds = 0;                ///< time of the solver
    WriteReport written = {};          ///< what was written after steps
    std::optional<Camera> camera = {}; ///< view of pictures after steps, which the last one shares
};

InputError as_input_error(const SolveError& error, const Problem& problem) {
    return as_input_error(error, problem.settings().scene.path, problem.loaded.scene.face_lines);
}

bool has_pictures(const SolveSettings& settings) {
    return std::ranges::any_of(settings.outputs, is_picture, &Output::kind) ||
           !settings.error_map.empty();
}

/// Returns the bytes of a table that is kept until the patches are divided.
double bytes_of_table(const PatchTable& table) {
    constexpr double bytes_per_row = sizeof(double) + 3 * sizeof(Vec3);
    return bytes_per_row * static_cast<double>(table.area.size());
}

void check_useful(const SolveSettings& settings) {
    if (settings.useful && !settings.work().estimates_error)
        throw UsageError("--useful: --method " + std::string(settings.method->name) +
                         " does not estimate its error, by which a picture is judged");
}

/// Returns how many texels all lightmaps have together.
double texels_of_lightmaps(const SolveSettings& settings, const FileLightmap& file) {
    const double side = settings.file_bake.asked ? 0 : settings.lightmap.value_or(0);
    double texels = side * side;
    for (const ObjectLightmap& part : file.parts)
        texels += double(part.layout.size) * part.layout.size;
    return texels;
}

/// Reads the files of the run; checks its options first, and then what they are for this scene.
Loaded load(SolveSettings settings) {
    if (settings.useful && !settings.gather) // it judges the picture of the patches
        settings.gather_pictures = false;
    const RunFiles files = check_files(settings);
    const std::span methods(&settings.method, 1);
    check_own_options(settings.options, methods);
    check_plain(settings);
    check_target(settings);
    check_layers(settings);
    check_useful(settings);
    check_checkpoint_options(settings);
    warn_of_unused(settings);
    Workers(settings.options.threads).start();
    std::optional<Checkpoint> resumed = read_resumed(settings);
    std::vector<NamedPoint> points;
    if (!settings.points.path.empty())
        points = read_points(settings.points.path);
    std::vector<TargetPoints> target_points = points_of_target(settings.target);
    PatchTable reference;
    if (!settings.reference.empty())
        reference = read_patch_table(settings.reference);
    LoadedMesh scene = load_mesh(
        settings.scene, files, settings.options, methods, settings.verbosity, [&](double patches) {
            return bytes_of_own_file(settings) + bytes_of_results(settings, patches) +
                   bytes_of_points(points.size(), settings.rays_of_gather()) +
                   bytes_of_table(reference);
        });
    const Mesh& mesh = scene.mesh;
    settings.divide_auto |= divides_by_default(settings, mesh.patches().size());
    check_distances(settings.points.path, points, mesh);
    settings.view = view_of(settings.view, scene.view,
                            has_pictures(settings) || !settings.report.empty() ? settings.verbosity
                                                                               : Verbosity::quiet);
    check_camera(settings.view, mesh, settings.scene.path);
    check_lightmap(settings, mesh);
    check_own_options(settings.options, methods, mesh.patches().size());
    check_plain(settings, mesh.patches().size());
    FileLightmap file_lightmap;
    if (settings.file_bake.asked)
        file_lightmap = lightmaps_to_write(settings, mesh, scene.origins, scene.warnings);
    check_layers(settings, mesh,
                 {.patches = double(mesh.patches().size()),
                  .points = double(points.size()),
                  .texels = texels_of_lightmaps(settings, file_lightmap)},
                 scene.need);
    (void)detail_mask(mesh, settings.detail); // names only groups of the scene
    return {std::move(settings),      std::move(resumed),   std::move(points),
            std::move(target_points), std::move(reference), std::move(scene),
            std::move(file_lightmap)};
}

/// Finds what belongs to the patches as they are then.
std::vector<double> target_of(const Problem& problem) {
    return target_weights(problem.settings(), problem.loaded.target_points, problem.mesh(),
                          problem.tracer());
}

/// Builds what solving needs besides the patches. From then on a signal ends the run with what
/// there is, which is watched before a stage is told of.
Problem build(Loaded loaded, Monitor& monitor, InterruptGuard& guard) {
    Problem problem{.loaded = std::move(loaded), .monitor = monitor};
    const SolveSettings& settings = problem.settings();
    problem.prepared = prepare(problem.loaded.scene, settings.options, settings.verbosity);
    problem.options =
        with_memory(settings.options, settings.scene, problem.loaded.scene.need.all());
    guard.watch(monitor.interrupted.own().wished);
    log_line(settings.verbosity, Verbosity::verbose,
             tracer_text(problem.prepared.made.tree, problem.prepared.seconds));
    problem.target = target_of(problem);
    return problem;
}

/// Begins a solver for the patches as they are then.
std::unique_ptr<Solver> begin(Problem& problem) {
    const SolveSettings& settings = problem.settings();
    const Method& method = *settings.method;
    const std::size_t patches = problem.mesh().patches().size();
    problem.options.rays =
        rays_of_step(settings.options.rays, settings.stop.seconds, method, patches);
    problem.options.stop = stop_rule(settings, patches);
    return make_solver(method, problem.input(), settings.plain);
}

/// Divides the patches where --divide auto asks for it.
Divided divide(Problem& problem, Statistics& statistics) {
    const Stage stage("dividing patches", problem.settings().verbosity);
    SolverInput input = problem.input();
    const auto mesh_changed = [&] {
        if (!problem.settings().options.keep_all)
            problem.prepared.needs = find_needs(problem.mesh());
        problem.target = target_of(problem);
        input.target = problem.target;
    };
    return divide_as_asked(
        problem.settings(), problem.loaded.scene.mesh, input, [&] { return begin(problem); },
        mesh_changed, statistics);
}

/// Takes the reference, which is of the patches as they are divided.
std::optional<Reference> take_reference(Problem& problem) {
    const std::string& path = problem.settings().reference;
    if (path.empty() || problem.monitor.interrupted)
        return std::nullopt;
    return reference_of(std::move(problem.loaded.reference), path, problem.mesh(),
                        detail_mask(problem.mesh(), problem.settings().detail));
}

LitScene lit_scene(const Problem& problem, const Solution& solution) {
    return {problem.mesh(), problem.tracer(), solution.radiosity,
            problem.settings().options.threads};
}

/// Takes the steps. Goes on with the run by which the patches were divided, where there is one.
Run take_steps(Problem& problem, Divided& divided, const std::optional<Reference>& reference,
               double seconds_divide, Preview& preview) {
    const SolveSettings& settings = problem.settings();
    const std::optional<Checkpoint>& resumed = problem.loaded.resumed;
    const Mesh& mesh = problem.mesh();
    Monitor& monitor = problem.monitor;
    StopRule stop = stop_rule(settings, mesh.patches().size(), divided.sampling);
    UsefulPicture picture(settings, mesh, problem.tracer());
    std::function<bool(const Solution&)> useful;
    if (settings.useful)
        useful = [&](const Solution& image) {
            const double similarity = picture.similarity(image);
            log_line(settings.verbosity, Verbosity::verbose,
                     formatted("picture: similarity of %.4f to one without noise", similarity));
            return similarity >= UsefulPicture::useful;
        };
    Progress progress(monitor, share_of(stop, *settings.method),
                      settings.verbosity != Verbosity::quiet && stderr_is_terminal());
    const Stopwatch solving;
    const bool is_begun = divided.begun && !resumed;
    Run done{.solver = is_begun ? std::move(divided.begun) : begin(problem),
             .rows = {},
             .lights = {},
             .notes = RunNotes(stop, settings.work().estimates_error)};
    log_rays_of_step(settings.verbosity, settings.options.rays, problem.options.rays);
    Before before = divided.before();
    before.seconds += seconds_divide; // a time limit is of both
    if (resumed) {
        before = resume(*resumed, settings, mesh, *done.solver);
        done.rows = resumed->rows;
    }
    Checkpointer checkpointer(settings, mesh, *done.solver);
    StepPictures step_pictures(settings, mesh, problem.tracer(), monitor.interrupted.own().wished);
    const auto add_row = [&](const StepRecord& record) {
        done.notes.step_done(record);
        done.rows.push_back({std::string(settings.method->name), 0, record, std::nullopt});
        progress.step_done(record);
    };
    const auto keep_light = [&](const Solution& solution) {
        if (settings.report.empty() || !std::has_single_bit(solution.steps))
            return;
        if (done.lights.empty())
            done.unit = mean_light(mesh, solution.radiosity);
        done.lights.push_back({solution.steps, halves_of(solution.radiosity, done.unit)});
    };
    const auto show_last_row = [&](const Solution& solution) {
        if (reference)
            done.rows.back().error = reference->error(mesh, solution.radiosity);
        step_pictures.write(solution.radiosity, solution.steps);
        log_line(settings.verbosity, Verbosity::verbose, step_text(done.rows.back()));
        preview.show(lit_scene(problem, solution), solution);
    };
    const auto after_step = [&](const StepRecord& record, const Solution& solution) {
        add_row(record);
        keep_light(solution);
        show_last_row(solution);
        checkpointer.step_done(done.rows, record.seconds);
    };
    if (is_begun && !divided.steps.empty()) {
        for (StepRecord record : divided.steps) {
            record.seconds += seconds_divide;
            add_row(record);
        }
        show_last_row(done.solver->solution());
    }
    try {
        done.completed = run(*done.solver, problem.input(), stop, after_step, before, useful);
    } catch (const SolveError& error) {
        if (done.solver->solution().steps == 0)
            throw;
        done.fault = as_input_error(error, problem);
    }
    done.seconds = solving.seconds() + (resumed ? resumed->seconds : divided.before().seconds);
    progress.close();
    checkpointer.finish(done.rows, done.seconds);
    done.written = step_pictures.report();
    done.written.add(checkpointer.report());
    done.camera = step_pictures.camera();
    return done;
}

/// Adds what is known of a solution, and how far off it is.
void add_errors(Statistics& statistics, const Problem& problem, const Divided& divided,
                const Solution& solution, double seconds_solver) {
    const SolveSettings& settings = problem.settings();
    const Stage stage("finding the error", settings.verbosity);
    fill(statistics, settings, problem.mesh(), solution, seconds_solver);
    // Without an estimate of sampling, the error of the division would be taken for the whole.
    if (!settings.work().estimates_error || !shows_statistics(settings))
        statistics.error_sampling = statistics.estimated_error;
    else
        add_division_error(statistics, settings, problem.mesh(), problem.tracer(), solution,
                           divided, problem.monitor.interrupted);
    if (!settings.plain) // which leaves out nothing
        statistics.left_out = left_out(problem.prepared.needs, settings.work(), solution);
    statistics.bytes_peak = peak_memory_bytes();
    if (settings.ranks->are_several())
        statistics.ranks =
            settings.ranks->of_each(RankFigures{settings.ranks->work(), statistics.bytes_peak});
}

/// Returns where surfaces lie in the lightmaps that are gathered.
std::vector<NamedLayout> lightmap_layouts(const Problem& problem) {
    const SolveSettings& settings = problem.settings();
    std::vector<NamedLayout> layouts;
    if (settings.file_bake.asked || !gathers_lightmap(settings)) {
        for (const ObjectLightmap& part : problem.loaded.file_lightmap.parts)
            layouts.push_back({part.name, part.layout});
        return layouts;
    }
    try {
        const int size = *settings.lightmap;
        layouts.push_back(
            {"",
             {placed_triangles(problem.mesh(), find_charts(problem.mesh(), size)), size, gutter}});
    } catch (const LightmapTooSmall&) { // which the output that fails reports
    }
    return layouts;
}

/// Adds what it took to gather the light of a target, and its error, which is that of the run.
void add_target(Statistics& statistics, const Answer<Solution>& gathered) {
    statistics.estimated_error = gathered.error.whole;
    statistics.error_bound = gathered.error.bound;
    statistics.estimated_error_uncertainty = gathered.error.uncertainty;
    statistics.rays_learn += gathered.work.rays_learn;
    statistics.rays_gather += gathered.work.rays_gather;
    statistics.seconds_learn += gathered.work.seconds_learn;
}

/// The light of the outputs.
struct GivenLight {
    GatheredLight gathered;
    LampLight lamps;
};

/// Gathers light where outputs show that; chooses the camera of pictures. Then finds what each lamp
/// brings of all this, where it is asked for.
GivenLight give_light(const Problem& problem, Run& done, const Solution& solution,
                      Statistics& statistics, Preview& preview) {
    const SolveSettings& settings = problem.settings();
    // Without a step, a file of the scene's own has the light of its lamps; values are not known.
    if (solution.steps == 0 && !settings.file_bake.asked)
        return {};
    const LitScene lit = lit_scene(problem, solution);
    const Asked asked = asked_of_gathers(settings, solution, statistics);
    WantedLight wanted{.bake = settings.bake, .error_of_patches = statistics.estimated_error};
    std::vector<NamedLayout> layouts;
    GivenLight given;
    if (gathers(settings) && settings.ranks->is_first()) {
        const OnThisRank works_alone(problem.monitor.interrupted);
        if (has_pictures(settings) && !done.camera)
            done.camera = shown_camera_of(settings.view, lit, settings.verbosity);
        layouts = lightmap_layouts(problem);
        if (done.camera)
            preview.begin_gathering(lit, solution, *done.camera);
        preview_lit_file(settings, lit, solution, problem.loaded.file_lightmap, layouts,
                         problem.monitor.interrupted.own().wished);
        if (solution.steps > 0)
            wanted.points = wanted_points(problem.loaded.points);
        wanted.lightmaps = layouts;
        if (gathers_picture(settings))
            wanted.picture = {*done.camera, settings.view.size, [&](const Image& rows, int count) {
                                  preview.show_rows(rows, count);
                              }};
        ProgramWatcher watcher(settings.verbosity);
        Gatherer gatherer(lit, solution, asked, problem.monitor, watcher);
        given.gathered = gather(gatherer, wanted);
        add_gathered(statistics, settings, given.gathered);
        log_error_of_points(settings, given.gathered);
    }
    given.lamps =
        find_lamp_light(settings, {lit, *done.solver, solution, given.gathered, wanted, asked},
                        problem.monitor, statistics);
    return given;
}

/// Writes the outputs; returns the exit code.
int write(const Problem& problem, const Run& done, const Solution& solution, Statistics& statistics,
          const GivenLight& given, const std::optional<Reference>& reference,
          const Stopwatch& started) {
    const Loaded& loaded = problem.loaded;
    SolveSettings settings = loaded.settings;
    if (!settings.ranks->is_first()) // whose result is the first one's
        return exit_done;
    const OnThisRank works_alone(problem.monitor.interrupted);
    const bool interrupted = !done.completed && !done.fault;
    settings.view.camera = done.camera;
    std::optional<Stage> stage(std::in_place, "writing", settings.verbosity);
    std::span<const LightOfStep> lights = done.lights;
    if (!lights.empty() && lights.back().step == solution.steps) // which is shown as the last one
        lights = lights.first(lights.size() - 1);
    const int code =
        finish(settings,
               {problem.mesh(), problem.tracer(), solution, settings.options, statistics, done.rows,
                lights, done.unit, loaded.points, given.gathered, given.lamps, loaded.file_lightmap,
                loaded.scene.warnings, problem.monitor},
               done.written, reference, done.notes, interrupted, started,
               loaded.resumed ? loaded.resumed->seconds : 0);
    stage.reset();
    if (interrupted && !settings.ranks->are_several())
        end_at_once(code);
    if (!done.fault || code != exit_done)
        return code;
    log_line(settings.verbosity, Verbosity::quiet,
             std::string("hemilux: ") + done.fault->what() + "\nthe outputs hold " +
                 counted(done.solver->solution().steps, "step", "steps") + " before that");
    return exit_input;
}

/// Solves the problem and writes the outputs; returns the exit code.
int solve(Problem& problem, const Stopwatch& started) {
    Statistics statistics;
    statistics.seconds_read = problem.loaded.scene.seconds_read;
    statistics.seconds_bvh = problem.prepared.seconds;
    Divided divided = divide(problem, statistics);
    const std::optional<Reference> reference = take_reference(problem);
    Preview preview(problem.settings(), problem.monitor.interrupted.own().wished);
    Run done = take_steps(problem, divided, reference, statistics.seconds_divide, preview);
    // Where a signal or the time left no step, the light by which patches were divided is used.
    const Solution* solution = &done.solver->solution();
    if (solution->steps == 0 && divided.rough.steps > 0)
        solution = &divided.rough;
    std::optional<Solution> linear; // with slopes
    if (divided.linear) {
        linear = *solution;
        linear->slope = divided.slope;
        solution = &*linear;
    }
    add_errors(statistics, problem, divided, *solution, done.seconds);
    std::optional<Solution> of_target; // with the light of its patches gathered
    if (gathers_target(problem.settings()) && solution->steps > 0 && done.completed &&
        problem.settings().ranks->is_first()) {
        const OnThisRank works_alone(problem.monitor.interrupted);
        const Stage stage("gathering the light of the target", problem.settings().verbosity);
        std::optional<Answer<Solution>> gathered = gather_patches(
            lit_scene(problem, *solution), *solution,
            asked_of_target(problem.settings(), *solution, statistics), problem.monitor);
        if (gathered) {
            add_target(statistics, *gathered);
            of_target = std::move(gathered->value);
            solution = &*of_target;
        }
    }
    const GivenLight given = give_light(problem, done, *solution, statistics, preview);
    return write(problem, done, *solution, statistics, given, reference, started);
}

} // namespace

int solve(const SolveSettings& settings) {
    const Stopwatch started;
    Monitor monitor;
    InterruptGuard guard;
    Problem problem = build(load(settings), monitor, guard);
    const SharedStop shared_stop(monitor.interrupted, *settings.ranks);
    try {
        return solve(problem, started);
    } catch (const SolveError& error) {
        throw as_input_error(error, problem);
    }
}

} // namespace hemilux
