#include "app/commands/solve_end.h"

#include "app/division/whole_error.h"
#include "app/gathering/lit_file_output.h"
#include "app/terminal/log.h"
#include "app/terminal/program_watcher.h"
#include "app/terminal/summary.h"
#include "io/files/printable.h"
#include "parallel/workers.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/answers/run/lost_light.h"
#include "radiosity/answers/run/unknown_groups.h"
#include "radiosity/engine/solving/left_out.h"
#include "radiosity/engine/solving/transport_figures.h"
#include "radiosity/paper/hemisphere/hemisphere.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace hemilux {

namespace {

/// Returns the seconds of the stages that have a name, before anything is written.
double seconds_of_stages(const Statistics& s) {
    const auto known = [](double seconds) { return std::isfinite(seconds) ? seconds : 0; };
    return known(s.seconds_read) + known(s.seconds_bvh) + s.seconds_divide +
           known(s.seconds_density) + known(s.seconds_solve) + known(s.seconds_division_error) +
           s.seconds_learn + s.seconds_gather + s.seconds_layers;
}

/// Returns what a user must know of a run that has ended, of which `findings` is told already.
Findings findings_of(const SolveSettings& settings, const Results& results, Findings findings,
                     bool interrupted) {
    if (!interrupted)
        add(findings, whole_error_note(settings, results.statistics));
    if (!gives_gathered_light(settings))
        add(findings, unknown_groups_finding(results.mesh, results.solution));
    add(findings,
        lost_light_finding(results.mesh, results.tracer, results.solution, settings.scene.sides));
    return findings;
}

constexpr const char* no_step_warning =
    "the time ended before the first step was done; the outputs hold emission alone; a longer "
    "--time or fewer --rays give a solution";

std::string interruption_text(std::uint32_t steps, bool wrote) {
    std::string when = "interrupted", outputs = counted(steps, "step", "steps");
    if (steps == 0) {
        when += " before the first step was done";
        outputs = "emission alone";
    }
    return wrote ? when + "; the outputs hold " + outputs : when;
}

/// Adds what suns and skies emit, and what all else reflects.
void add_powers(Statistics& statistics, const Mesh& mesh, const Solution& solution) {
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i) {
        const double area = mesh.frame().area_to_world(mesh.patches()[i].area);
        const Material& material = mesh.material(i);
        const Vec3 power = area * (material.is_far ? material.emission
                                                   : solution.radiosity[i] - material.emission);
        (material.is_far ? statistics.emitted_far : statistics.reflected) +=
            power.r + power.g + power.b;
    }
}

/// Decides which error is that of the run: with --divide auto that of the light as given out, else
/// that of the patches' means.
void add_errors(Statistics& statistics, const SolveSettings& settings, const Solution& solution,
                const StageFigures& stages) {
    const WholeError& error = stages.error;
    const bool is_whole = stages.is_whole && settings.divide_auto;
    statistics.estimated_error = is_whole ? error.error() : error.sampling;
    statistics.estimated_error_uncertainty =
        is_whole ? error.uncertainty() : error.sampling_uncertainty;
    statistics.error_sampling = error.sampling;
    statistics.error_division = error.division.error;
    statistics.error_division_uncertainty = error.division.uncertainty;
    statistics.target = settings.target.names();
    if (!statistics.target.empty())
        statistics.estimated_error_of = ErrorOf::target;
    if (is_whole && solution.weight.empty())
        statistics.estimated_error_of = ErrorOf::surfaces;
}

} // namespace

Statistics statistics_of(const SolveSettings& settings, const Problem& problem,
                         const Solution& solution, const StageFigures& stages) {
    const Mesh& mesh = *problem.mesh;
    Statistics statistics;
    statistics.seconds_read = stages.seconds_read;
    statistics.seconds_bvh = stages.seconds_tree;
    statistics.seconds_divide = stages.division.seconds;
    statistics.rays_divide = stages.division.rays;
    statistics.rays_division_error = stages.division.rays_error + stages.error.rays;
    if (settings.divide_auto || stages.error.seconds > 0)
        statistics.seconds_division_error = stages.division.seconds_error + stages.error.seconds;
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
    statistics.seconds_solve = std::max(0.0, stages.seconds_solver - solution.seconds_density);
    statistics.rays_per_second =
        static_cast<double>(solution.rays_energy + solution.rays_density) / stages.seconds_solver;
    statistics.bytes_density = solution.bytes_density;
    statistics.bytes_transport = solution.figures.value(transport_figures::bytes);
    statistics.links = solution.figures.value("links"); // of `hierarchical`
    if (solution.bytes_density > 0)
        statistics.bytes_density_paper =
            statistics.patches * Hemisphere::cells_up_to(settings.options.depth);
    add_errors(statistics, settings, solution, stages);
    statistics.estimated_error_elsewhere = estimated_error_elsewhere(mesh, solution);
    statistics.energy = solution.energy;
    add_powers(statistics, mesh, solution);
    if (!settings.plain) // which leaves out nothing
        statistics.left_out = left_out(problem.needs, settings.work(), solution);
    statistics.bytes_peak = peak_memory_bytes();
    if (settings.ranks->are_several())
        statistics.ranks =
            settings.ranks->of_each(RankFigures{settings.ranks->work(), statistics.bytes_peak});
    return statistics;
}

int finish(const SolveSettings& settings, Results results, const WriteReport& of_steps,
           const std::optional<Reference>& reference, const Findings& of_run, bool interrupted,
           const Stopwatch& started, double seconds_before) {
    const std::vector<std::string> warnings =
        texts_of(findings_of(settings, results, of_run, interrupted));
    const bool no_step = results.solution.steps == 0 && !interrupted;
    std::vector<std::string> all(results.warnings.begin(), results.warnings.end());
    all.insert(all.end(), warnings.begin(), warnings.end());
    if (no_step)
        all.emplace_back(no_step_warning);
    if (interrupted)
        all.push_back("the run was interrupted after " +
                      counted(results.solution.steps, "step", "steps"));
    results.warnings = all;
    results.statistics.seconds_analysis =
        std::max(0.0, started.seconds() + seconds_before - seconds_of_stages(results.statistics));
    WriteReport report = write_results(settings, results, started);
    report.add(of_steps);
    const bool ends_early(results.monitor.interrupted); // in whatever stage
    log_line(settings.verbosity, Verbosity::normal, run_text(results.statistics));
    log_warnings(settings.verbosity, warnings);
    if (no_step)
        log_line(settings.verbosity, Verbosity::quiet, std::string("warning: ") + no_step_warning);
    log_line(settings.verbosity, Verbosity::verbose, memory_text(results.statistics));
    if (reference) {
        const Solution& solution = results.solution;
        log_line(settings.verbosity, Verbosity::normal,
                 error_text(reference->error(results.mesh, solution.radiosity)));
        log_line(settings.verbosity, Verbosity::normal,
                 z_scores_text(z_scores(results.mesh, solution, reference->radiosity,
                                        reference->standard_error)));
    }
    log_line(settings.verbosity, Verbosity::normal, time_text(results.statistics));
    report.log(settings.verbosity);
    if (const std::string how = how_to_look(settings, results.file_lightmap);
        !how.empty() && report.failed.empty() && report.left_out.empty())
        log_line(settings.verbosity, Verbosity::normal, single_line(how));
    if (interrupted || ends_early)
        log_line(settings.verbosity, Verbosity::quiet,
                 interruption_text(results.solution.steps, !report.written.empty()));
    return report.exit_code(ends_early);
}

} // namespace hemilux
