// hemilux solve: read, divide, build, run, write.

#include "app/commands/commands.h"
#include "app/loading/load.h"
#include "app/loading/reference.h"
#include "app/loading/sides.h"
#include "app/running/checkpointing.h"
#include "app/running/division.h"
#include "app/running/point_table.h"
#include "app/running/results.h"
#include "app/running/run_notes.h"
#include "app/running/signals.h"
#include "app/running/step_pictures.h"
#include "app/running/step_size.h"
#include "app/settings/exit_code.h"
#include "app/settings/memory.h"
#include "app/settings/method_options.h"
#include "app/settings/text.h"
#include "app/settings/view.h"
#include "app/terminal/log.h"
#include "app/terminal/progress.h"
#include "app/terminal/stopwatch.h"
#include "app/terminal/summary.h"
#include "radiosity/hemisphere/hemisphere.h"
#include "radiosity/sampling/workers.h"
#include "radiosity/solving/error_spread.h"
#include "radiosity/solving/left_out.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace hemilux {

namespace {

/// A run to an error ends at a number of rays at the latest, if nothing else ends it.
std::uint64_t default_max_rays(std::size_t patches) {
    constexpr std::uint64_t least = 100'000'000, each = 1000;
    return least + each * patches;
}

StopRule stop_rule(const SolveSettings& settings, std::size_t patches) {
    StopRule stop = settings.stop;
    if (settings.divide_auto && (stop.error || (!stop.steps && !stop.seconds)))
        stop.error = sampling_share * whole_error(settings);
    if (!stop.steps && !stop.seconds && !stop.error) {
        stop = settings.method->default_stop;
        stop.rays = settings.stop.rays;
    }
    if (!stop.steps && !stop.seconds && !stop.error)
        stop.steps = StopRule::default_steps;
    if (!stop.steps && !stop.seconds && !stop.rays)
        stop.rays = default_max_rays(patches);
    return stop;
}

void fill(Statistics& statistics, const SolveSettings& settings, const Mesh& mesh,
          const Solution& solution, double seconds_solver) {
    statistics.patches = mesh.patches().size();
    statistics.faces = mesh.scene().faces;
    statistics.materials = mesh.scene().materials.size();
    statistics.method = settings.method->name;
    statistics.seed = settings.options.seed;
    statistics.threads = Workers(settings.options.threads).threads();
    statistics.steps = solution.steps;
    statistics.rays_energy = solution.rays_energy;
    statistics.rays_density = solution.rays_density;
    statistics.seconds_density = solution.seconds_density;
    statistics.seconds_solve = std::max(0.0, seconds_solver - solution.seconds_density);
    statistics.rays_per_second =
        static_cast<double>(solution.rays_energy + solution.rays_density) / seconds_solver;
    statistics.bytes_density = solution.bytes_density;
    statistics.bytes_transport = solution.bytes_transport;
    if (solution.bytes_density > 0)
        statistics.bytes_density_paper =
            statistics.patches * Hemisphere::cells_up_to(settings.options.depth);
    statistics.estimated_error = estimated_error(mesh, solution);
    statistics.estimated_error_uncertainty =
        statistics.estimated_error * error_spread(mesh, solution).uncertainty();
    statistics.energy = solution.energy;
}

std::unique_ptr<Solver> make_solver(const SolveSettings& settings, const SolverInput& input,
                                    std::span<const std::uint32_t> face_lines) {
    try {
        return settings.plain ? settings.method->plain(input) : settings.method->make(input);
    } catch (const SolveError& error) {
        throw as_input_error(error, settings.scene.path, face_lines);
    }
}

std::string lost_light_of(const SolveSettings& settings, const Results& results) {
    if (results.solution.steps == 0)
        return "";
    const LightShares light = find_light_shares(results.mesh, results.tracer);
    return lost_light_text(results.mesh, results.solution.radiosity, light, settings.scene.sides);
}

/// Those of the stages that have a name, before anything is written.
double seconds_of_stages(const Statistics& s) {
    const auto known = [](double seconds) { return std::isfinite(seconds) ? seconds : 0; };
    return known(s.seconds_read) + known(s.seconds_bvh) + s.seconds_divide +
           known(s.seconds_density) + known(s.seconds_solve) + known(s.seconds_division_error);
}

/// The last words; returns the exit code. `seconds_before`: of the run that this one goes on with.
int finish(const SolveSettings& settings, const Results& results, const WriteReport& of_steps,
           const std::optional<Reference>& reference, const RunNotes& notes, bool interrupted,
           const Stopwatch& started, double seconds_before) {
    const std::string lost_light = lost_light_of(settings, results);
    results.statistics.seconds_analysis =
        std::max(0.0, started.seconds() + seconds_before - seconds_of_stages(results.statistics));
    WriteReport report = write_results(settings, results, started);
    report.add(of_steps);
    log_line(settings.verbosity, Verbosity::normal, run_text(results.statistics));
    for (const std::string& note : notes.texts(results.statistics.error_sampling, interrupted))
        log_line(settings.verbosity, Verbosity::normal, "warning: " + note);
    if (!lost_light.empty())
        log_line(settings.verbosity, Verbosity::normal, "warning: " + lost_light);
    if (results.solution.steps == 0 && !interrupted)
        log_line(
            settings.verbosity, Verbosity::quiet,
            "warning: the time ended before the first step was done; the outputs hold emission "
            "alone; a longer --time or fewer --rays give a solution");
    log_line(settings.verbosity, Verbosity::verbose, memory_text(results.statistics));
    if (reference) {
        const Solution& solution = results.solution;
        log_line(settings.verbosity, Verbosity::normal,
                 error_text(reference->error(results.mesh, solution.radiosity)));
        log_line(settings.verbosity, Verbosity::normal,
                 z_scores_text(z_scores(results.mesh, solution, reference->radiosity,
                                        reference->standard_error)));
    }
    report.log(settings.verbosity);
    if (interrupted)
        log_line(
            settings.verbosity, Verbosity::quiet,
            results.solution.steps > 0
                ? "interrupted; the outputs hold " +
                      counted(results.solution.steps, "step", "steps")
                : "interrupted before the first step was done; the outputs hold emission alone");
    return report.exit_code(results.interrupted);
}

} // namespace

int solve(const SolveSettings& settings) {
    const Stopwatch started;
    const RunFiles files = check_files(settings);
    const std::span methods(&settings.method, 1);
    check_own_options(settings.options, methods);
    check_plain(settings);
    check_checkpoint_options(settings);
    Monitor monitor;
    InterruptGuard guard;
    Statistics statistics;

    Workers(settings.options.threads).start();
    const std::optional<Checkpoint> resumed = read_resumed(settings);
    const std::vector<NamedPoint> points = points_of(settings);
    LoadedMesh loaded =
        load_mesh(settings.scene, files, settings.options, methods, settings.verbosity,
                  (std::ranges::any_of(settings.outputs, is_picture, &Output::kind) ||
                           !settings.error_map.empty()
                       ? bytes_of_picture(settings.view.size, settings.gather_pictures)
                       : 0) +
                      bytes_of_points(points.size(), settings.gather));
    const Mesh& mesh = loaded.mesh;
    check_distances(settings, points, mesh);
    check_camera(settings.view, mesh);
    check_exact(settings.options, mesh.patches().size());
    check_plain(settings, mesh.patches().size());
    statistics.seconds_read = loaded.seconds_read;
    Prepared prepared = prepare(loaded, settings.options);
    const auto& [tracer, tree] = prepared.made;
    statistics.seconds_bvh = prepared.seconds;
    log_line(settings.verbosity, Verbosity::verbose, tracer_text(tree, statistics.seconds_bvh));
    const Needs& needs = prepared.needs;
    SolveOptions options = with_memory(settings.options, settings.scene);
    const SolverInput input{mesh, *tracer, options, monitor, needs};
    const auto begin = [&] {
        const StopRule stop = stop_rule(settings, mesh.patches().size());
        options.rays = rays_of_step(settings.options.rays, settings.stop.seconds, *settings.method,
                                    mesh.patches().size());
        options.growing_steps = !stop.steps;
        options.aim = stop.error.value_or(0);
        options.expected_steps = expected_steps(stop);
        return make_solver(settings, input, loaded.face_lines);
    };
    guard.watch(monitor.interrupted);
    Divided divided;
    try {
        divided = divide_as_asked(settings, loaded.mesh, input, begin, statistics);
    } catch (const SolveError& error) {
        throw as_input_error(error, settings.scene.path, loaded.face_lines);
    }
    if (divided.patches && !settings.options.keep_all)
        prepared.needs = find_needs(mesh);
    const StopRule stop = stop_rule(settings, mesh.patches().size());
    std::vector<bool> detail = detail_mask(mesh, settings.detail);
    std::optional<Reference> reference;
    if (!settings.reference.empty() && !monitor.interrupted) {
        guard.unwatch();
        reference = read_reference(settings.reference, mesh, std::move(detail));
        guard.watch(monitor.interrupted);
    }
    Progress progress(monitor, share_of(stop, *settings.method),
                      settings.verbosity != Verbosity::quiet && stderr_is_terminal());
    const Stopwatch solving;
    const std::unique_ptr<Solver> solver =
        divided.begun && !resumed ? std::move(divided.begun) : begin();
    log_rays_of_step(settings.verbosity, settings.options.rays, options.rays);
    std::vector<StepRow> rows;
    Before before = divided.before;
    before.seconds += statistics.seconds_divide; // a time limit is of both
    if (resumed) {
        before = resume(*resumed, settings, mesh, *solver);
        rows = resumed->rows;
    }
    Checkpointer checkpointer(settings, mesh, *solver);
    StepPictures step_pictures(settings, mesh, *tracer, monitor.interrupted);
    RunNotes notes(stop);
    const auto after_step = [&](const StepRecord& record, const Solution& solution) {
        notes.step_done(record);
        rows.push_back({std::string(settings.method->name), 0, record, std::nullopt});
        if (reference)
            rows.back().error = reference->error(mesh, solution.radiosity);
        progress.step_done(record);
        if (settings.every_step)
            step_pictures.write(solution.radiosity, record.step);
        if (settings.verbosity == Verbosity::verbose)
            progress.log(step_text(rows.back()));
        checkpointer.step_done(rows, record.seconds);
    };
    bool completed = false;
    std::optional<InputError> fault; // in a step; those before it are written
    try {
        completed = run(*solver, input, stop, after_step, before);
    } catch (const SolveError& error) {
        fault = as_input_error(error, settings.scene.path, loaded.face_lines);
        if (solver->solution().steps == 0)
            throw *fault;
    }
    const double seconds_solver =
        solving.seconds() + (resumed ? resumed->seconds : divided.before.seconds);
    progress.close();
    checkpointer.finish(rows, seconds_solver);

    std::optional<Solution> linear;
    if (divided.linear)
        add_slopes(settings, mesh, *tracer, linear.emplace(solver->solution()), monitor.interrupted,
                   statistics);
    // Where a signal or the time left no step, there is the light by which patches were divided.
    const bool has_step = solver->solution().steps > 0 || divided.rough.steps == 0;
    const Solution& solution = !has_step ? divided.rough : linear ? *linear : solver->solution();
    fill(statistics, settings, mesh, solution, seconds_solver);
    add_division_error(statistics, settings, mesh, *tracer, solution, monitor.interrupted);
    if (!settings.plain) // which leaves out nothing
        statistics.left_out = left_out(needs, *settings.method, solution);
    statistics.bytes_peak = peak_memory_bytes();
    WriteReport of_run = step_pictures.report();
    of_run.add(checkpointer.report());
    const bool interrupted = !completed && !fault;
    SolveSettings shown = settings; // the last picture has the view of those before
    shown.view.camera = step_pictures.camera();
    const int code =
        finish(shown, {mesh, *tracer, solution, statistics, rows, points, monitor.interrupted},
               of_run, reference, notes, interrupted, started, resumed ? resumed->seconds : 0);
    if (interrupted)
        end_at_once(code);
    if (!fault || code != exit_done)
        return code;
    log_line(settings.verbosity, Verbosity::quiet,
             std::string("hemilux: ") + fault->what() + "\nthe outputs hold " +
                 counted(solver->solution().steps, "step", "steps") + " before that");
    return exit_input;
}

} // namespace hemilux
