// hemilux solve: load, build, divide, take steps, write.

#include "app/commands/commands.h"
#include "app/commands/solve_end.h"
#include "app/commands/watched_run.h"
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
#include "app/rendering/view.h"
#include "app/running/checkpointing.h"
#include "app/running/run_files.h"
#include "app/running/run_target.h"
#include "app/running/signals.h"
#include "app/settings/exit_code.h"
#include "app/settings/method_options.h"
#include "app/terminal/log.h"
#include "app/terminal/program_watcher.h"
#include "app/terminal/stage.h"
#include "app/terminal/summary.h"
#include "app/terminal/unused_options.h"
#include "io/results/points.h"
#include "parallel/stopwatch.h"
#include "parallel/workers.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/answers/charts/charts.h"
#include "radiosity/answers/division/division.h"
#include "radiosity/answers/gathering/light_of_patches.h"
#include "radiosity/answers/run/run_findings.h"
#include "radiosity/answers/run/step_size.h"
#include "radiosity/engine/solving/shared_stop.h"

#include <algorithm>
#include <memory>
#include <span>

namespace hemilux {

namespace {

/// All that a run reads before it builds anything.
struct Loaded {
    SolveSettings settings; ///< options with the camera of the scene, where none was given
    std::optional<Checkpoint> resumed;
    std::vector<NamedPoint> points;          ///< points of --points
    std::vector<PointsOfFile> target_points; ///< points of --for
    PatchTable reference;                    ///< table of --reference
    LoadedMesh scene;
    FileLightmap file_lightmap; ///< of `bake`
};

/// A run, from what it reads to its outputs.
struct Task {
    Loaded loaded;
    Monitor& monitor; ///< the caller's
    RunChoices choices = {};
    std::shared_ptr<const Problem> problem = nullptr; ///< with its patches as they are divided
    double seconds_tree = 0;

    [[nodiscard]] const SolveSettings& settings() const { return loaded.settings; }
    [[nodiscard]] const Mesh& mesh() const { return *problem->mesh; }
    [[nodiscard]] const Tracer& tracer() const { return *problem->tracer; }
};

/// A run whose steps are done.
struct Done {
    Run run;
    StopRule stop;
    std::optional<InputError> fault = {}; ///< fault in a step; the steps before it are written
    KeptSteps kept = {};
    std::optional<Camera> camera = {}; ///< view of pictures
};

InputError as_input_error(const SolveError& error, const Task& task) {
    return as_input_error(error, task.settings().scene.path, task.loaded.scene.face_lines);
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
    std::vector<PointsOfFile> target_points = points_of_target(settings.target);
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

/// Builds what solving needs besides the patches. From then on a signal ends the run with what
/// there is, which is watched before a stage is told of.
Problem build(Task& task, InterruptGuard& guard) {
    const SolveSettings& settings = task.settings();
    auto [problem, seconds] = prepare(task.loaded.scene, settings.options, settings.verbosity);
    task.seconds_tree = seconds;
    task.choices = run_choices(settings, task.loaded.scene.need.all());
    guard.watch(task.monitor.interrupted.own().wished);
    log_line(settings.verbosity, Verbosity::verbose, tracer_text(problem.tree, seconds));
    aim_at(problem, settings, task.loaded.target_points);
    return std::move(problem);
}

/// Divides the patches where --divide auto asks for it.
Divided divide(const Task& task, Problem problem) {
    const SolveSettings& settings = task.settings();
    if (!settings.divide_auto)
        return {.problem = std::make_shared<const Problem>(std::move(problem))};
    const Stage stage("dividing patches", settings.verbosity);
    ProgramWatcher watcher(settings.verbosity);
    return divide(std::move(problem), task.choices, division_choices(settings), task.monitor,
                  watcher);
}

/// Takes the reference, which is of the patches as they are divided.
std::optional<Reference> take_reference(Task& task) {
    const std::string& path = task.settings().reference;
    if (path.empty() || task.monitor.interrupted)
        return std::nullopt;
    return reference_of(std::move(task.loaded.reference), path, task.mesh(),
                        detail_mask(task.mesh(), task.settings().detail));
}

LitScene lit_scene(const Task& task, const Solution& solution) {
    return {task.mesh(), task.tracer(), solution.radiosity, task.settings().options.threads};
}

/// Lets a run go on from the checkpoint.
void resume(Run& run, const Checkpoint& checkpoint, const SolveSettings& settings) {
    run.before = resume(checkpoint, settings, run.mesh(), *run.solver);
    run.seconds += checkpoint.seconds;
    for (const StepRow& row : checkpoint.rows)
        run.steps.push_back(row.record);
}

/// Takes the steps. Goes on with the run by which the patches were divided, where there is one.
Done take_steps(const Task& task, Divided& divided, const std::optional<Reference>& reference,
                Preview& preview) {
    const SolveSettings& settings = task.settings();
    const std::optional<Checkpoint>& resumed = task.loaded.resumed;
    RunChoices choices = task.choices;
    if (divided.sampling)
        choices.sampling = divided.sampling;
    const StopRule stop = stop_rule(choices, task.mesh().patches().size());
    WatchedRun watched(settings, *task.problem, stop, task.monitor, reference, preview);
    const bool is_begun = divided.run && !resumed;
    Done done{.run = is_begun ? *std::move(divided.run)
                              : begin(task.problem, task.choices, task.monitor),
              .stop = stop};
    if (const auto smaller = smaller_step_finding(settings.options.rays, done.run.options->rays))
        watched.take(*smaller);
    done.run.add_time_before(divided.work.seconds); // a time limit is of both
    if (resumed) {
        resume(done.run, *resumed, settings);
        watched.watch_resumed(done.run, resumed->rows);
    } else
        watched.watch(done.run);
    try {
        go_on(done.run, stop, watched);
    } catch (const SolveError& error) {
        if (done.run.solution().steps == 0)
            throw;
        done.fault = as_input_error(error, task);
    }
    done.kept = watched.finish();
    done.camera = done.kept.camera;
    return done;
}

/// Puts together what is known of a solution, and finds how far off it is.
Statistics figures_of(const Task& task, const Divided& divided, const Run& run,
                      const Solution& solution) {
    const SolveSettings& settings = task.settings();
    const Stage stage("finding the error", settings.verbosity);
    StageFigures stages{.seconds_read = task.loaded.scene.seconds_read,
                        .seconds_tree = task.seconds_tree,
                        .seconds_solver = run.seconds,
                        .division = divided.work,
                        .error = error_of_sampling(task.mesh(), solution)};
    // Without an estimate of sampling, the error of the division would be taken for the whole.
    stages.is_whole = settings.work().estimates_error && shows_statistics(settings) &&
                      finds_whole_error(settings, solution);
    if (stages.is_whole)
        find_error_of_division(stages.error, divided, solution,
                               {.is_asked_for = settings.divide_auto,
                                .seed = settings.options.seed,
                                .threads = settings.options.threads},
                               task.monitor.interrupted);
    return statistics_of(settings, *task.problem, solution, stages);
}

/// Returns where surfaces lie in the lightmaps that are gathered.
std::vector<NamedLayout> lightmap_layouts(const Task& problem) {
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

/// The light of the outputs.
struct GivenLight {
    GatheredLight gathered;
    LampLight lamps;
};

/// Gathers light where outputs show that; chooses the camera of pictures. Then finds what each lamp
/// brings of all this, where it is asked for.
GivenLight give_light(const Task& problem, Done& done, const Solution& solution,
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
        find_lamp_light(settings, {lit, *done.run.solver, solution, given.gathered, wanted, asked},
                        problem.monitor, statistics);
    return given;
}

/// Writes the outputs; returns the exit code.
int write(const Task& task, const Done& done, const Solution& solution, Statistics& statistics,
          const GivenLight& given, const std::optional<Reference>& reference,
          const Stopwatch& started) {
    const Loaded& loaded = task.loaded;
    SolveSettings settings = loaded.settings;
    if (!settings.ranks->is_first()) // whose result is the first one's
        return exit_done;
    const OnThisRank works_alone(task.monitor.interrupted);
    const bool interrupted = !done.run.completed && !done.fault;
    settings.view.camera = done.camera;
    std::optional<Stage> stage(std::in_place, "writing", settings.verbosity);
    std::span<const LightOfStep> lights = done.kept.lights;
    if (!lights.empty() && lights.back().step == solution.steps) // which is shown as the last one
        lights = lights.first(lights.size() - 1);
    const RunEnd end{done.stop, settings.work().estimates_error, statistics.error_sampling,
                     interrupted};
    const int code =
        finish(settings,
               {task.mesh(), task.tracer(), solution, settings.options, statistics, done.kept.rows,
                lights, done.kept.unit, loaded.points, given.gathered, given.lamps,
                loaded.file_lightmap, loaded.scene.warnings, task.monitor},
               done.kept.written, reference, run_findings(done.run.steps, end), interrupted,
               started, loaded.resumed ? loaded.resumed->seconds : 0);
    stage.reset();
    if (interrupted && !settings.ranks->are_several())
        end_at_once(code);
    if (!done.fault || code != exit_done)
        return code;
    log_line(settings.verbosity, Verbosity::quiet,
             std::string("hemilux: ") + done.fault->what() + "\nthe outputs hold " +
                 counted(done.run.solution().steps, "step", "steps") + " before that");
    return exit_input;
}

/// Solves the problem and writes the outputs; returns the exit code.
int solve(Task& task, Problem undivided, const Stopwatch& started) {
    Divided divided = divide(task, std::move(undivided));
    task.problem = divided.problem;
    const std::optional<Reference> reference = take_reference(task);
    Preview preview(task.settings(), task.monitor.interrupted.own().wished);
    Done done = take_steps(task, divided, reference, preview);
    // Where a signal or the time left no step, the light by which patches were divided is used.
    const Solution* solution = &done.run.solution();
    if (solution->steps == 0 && divided.rough.steps > 0)
        solution = &divided.rough;
    std::optional<Solution> linear; // with slopes
    if (divided.linear) {
        linear = *solution;
        linear->slope = divided.slope;
        solution = &*linear;
    }
    Statistics statistics = figures_of(task, divided, done.run, *solution);
    std::optional<Solution> of_target; // with the light of its patches gathered
    if (gathers_target(task.settings()) && solution->steps > 0 && done.run.completed &&
        task.settings().ranks->is_first()) {
        const OnThisRank works_alone(task.monitor.interrupted);
        const Stage stage("gathering the light of the target", task.settings().verbosity);
        std::optional<Answer<Solution>> gathered =
            gather_patches(lit_scene(task, *solution), *solution,
                           asked_of_target(task.settings(), *solution, statistics), task.monitor);
        if (gathered) {
            add_target(statistics, *gathered);
            of_target = std::move(gathered->value);
            solution = &*of_target;
        }
    }
    const GivenLight given = give_light(task, done, *solution, statistics, preview);
    return write(task, done, *solution, statistics, given, reference, started);
}

} // namespace

int solve(const SolveSettings& settings) {
    const Stopwatch started;
    Monitor monitor;
    InterruptGuard guard;
    Task task{load(settings), monitor};
    Problem problem = build(task, guard);
    const SharedStop shared_stop(monitor.interrupted, *settings.ranks);
    try {
        return solve(task, std::move(problem), started);
    } catch (const SolveError& error) {
        throw as_input_error(error, task);
    }
}

} // namespace hemilux
