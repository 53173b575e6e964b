// hemilux solve: read, divide, build, run, write.

#include "app/commands.h"
#include "app/exit_code.h"
#include "app/load.h"
#include "app/progress.h"
#include "app/reference.h"
#include "app/results.h"
#include "app/signals.h"
#include "app/summary.h"
#include "app/text.h"
#include "bvh/bvh.h"
#include "radiosity/hemisphere.h"
#include "radiosity/workers.h"

#include <cstdio>

namespace hemilux {

namespace {

constexpr std::size_t most_warnings = 10;

class Stopwatch {
  public:
    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Says a line unless the user wants less talk than that.
void say(const SolveSettings& settings, Talk least, const std::string& line) {
    if (settings.talk >= least)
        std::fprintf(stderr, "%s\n", line.c_str());
}

void say_warnings(const SolveSettings& settings, const std::vector<std::string>& warnings) {
    const bool all = settings.talk == Talk::verbose || warnings.size() <= most_warnings;
    const std::size_t shown = all ? warnings.size() : most_warnings;
    for (std::size_t i = 0; i < shown; ++i)
        say(settings, Talk::normal, "warning: " + warnings[i]);
    if (!all)
        say(settings, Talk::normal,
            formatted("warning: and %zu more (-v shows all)", warnings.size() - shown));
}

StopRule stop_rule(const SolveSettings& settings) {
    const StopRule& given = settings.stop;
    if (given.steps || given.seconds || given.error)
        return given;
    StopRule stop = settings.method->default_stop;
    if (!stop.steps && !stop.seconds && !stop.error)
        stop.steps = StopRule::default_steps;
    return stop;
}

/// A patch table of the same patches, and which of these are reported apart.
struct Comparison {
    PatchTable table;
    std::vector<bool> detail;

    [[nodiscard]] RelativeError error(const Mesh& mesh, const Solution& solution) const {
        return true_error(mesh, solution.radiosity, table.radiosity, detail);
    }
};

std::optional<Comparison> comparison(const SolveSettings& settings, const Mesh& mesh) {
    std::vector<bool> detail = detail_mask(mesh, settings.detail);
    if (settings.reference.empty())
        return std::nullopt;
    Comparison result{read_patch_table(settings.reference), std::move(detail)};
    check_same_patches(result.table, settings.reference, mesh);
    return result;
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
    if (solution.bytes_density > 0)
        statistics.bytes_density_paper =
            statistics.patches * Hemisphere::cells_up_to(settings.options.depth);
    statistics.estimated_error = estimated_error(mesh, solution);
    statistics.energy = solution.energy;
}

/// The last words; returns the exit code.
int finish(const SolveSettings& settings, const Results& results,
           const std::optional<Comparison>& compared, bool interrupted) {
    const WriteReport report = write_results(settings, results);
    say(settings, Talk::normal, run_text(results.statistics));
    say(settings, Talk::verbose, memory_text(results.statistics));
    if (compared) {
        const Solution& solution = results.solution;
        say(settings, Talk::normal, error_text(compared->error(results.mesh, solution)));
        say(settings, Talk::normal,
            z_scores_text(z_scores(results.mesh, solution, compared->table.radiosity,
                                   compared->table.standard_error)));
    }
    for (const std::string& path : report.written)
        say(settings, Talk::normal, "wrote " + path);
    for (const std::string& message : report.failed)
        say(settings, Talk::quiet, "hemilux: " + message);
    if (interrupted)
        say(settings, Talk::quiet,
            results.solution.steps > 0
                ? "interrupted; the outputs hold " +
                      counted(results.solution.steps, "step", "steps")
                : "interrupted before the first step was done; the outputs hold emission alone");
    if (!report.failed.empty())
        return exit_output;
    return interrupted ? exit_interrupted : exit_done;
}

} // namespace

int solve(const SolveSettings& settings) {
    check_outputs(settings);
    const StopRule stop = stop_rule(settings);
    Monitor monitor;
    const InterruptGuard guard(monitor.interrupted);
    Statistics statistics;

    const Stopwatch reading;
    ReadResult read = load_scene(settings.scene);
    say_warnings(settings, read.warnings);
    check_solvable(read, settings.scene.path);
    statistics.seconds_read = reading.seconds();

    const Mesh mesh = divide_scene(std::move(read.scene), settings.scene);
    say(settings, Talk::verbose, mesh_text(mesh));
    const std::optional<Comparison> compared = comparison(settings, mesh);
    const Stopwatch building;
    const Bvh bvh(mesh.soup());
    statistics.seconds_bvh = building.seconds();
    say(settings, Talk::verbose, bvh_text(bvh.quality(), statistics.seconds_bvh));

    Progress progress(monitor, stop, settings.talk != Talk::quiet && stderr_is_terminal());
    const Stopwatch solving;
    const SolverInput input{mesh, bvh, settings.options, monitor};
    const std::unique_ptr<Solver> solver = settings.method->make(input);
    std::vector<StepRow> rows;
    const bool completed =
        run(*solver, input, stop, [&](const StepRecord& record, const Solution& solution) {
            rows.push_back({std::string(settings.method->name), 0, record, std::nullopt});
            if (compared)
                rows.back().error = compared->error(mesh, solution);
            progress.step_done(record);
            if (settings.talk == Talk::verbose)
                progress.say(step_text(rows.back()));
        });
    const double seconds_solver = solving.seconds();
    progress.close();

    fill(statistics, settings, mesh, solver->solution(), seconds_solver);
    statistics.bytes_peak = peak_memory_bytes();
    return finish(settings, {mesh, bvh, solver->solution(), statistics, rows}, compared,
                  !completed);
}

} // namespace hemilux
