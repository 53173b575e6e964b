// hemilux compare: a reference, all runs, files and a table.

#include "app/commands/commands.h"
#include "app/commands/compare_outputs.h"
#include "app/commands/compare_run.h"
#include "app/commands/compare_summary.h"
#include "app/loading/load.h"
#include "app/memory/memory.h"
#include "app/rendering/view.h"
#include "app/report/comparison_page.h"
#include "app/running/signals.h"
#include "app/settings/exit_code.h"
#include "app/settings/method_options.h"
#include "app/settings/names.h"
#include "app/terminal/log.h"
#include "app/terminal/print.h"
#include "app/terminal/progress.h"
#include "app/terminal/stage.h"
#include "app/terminal/summary.h"
#include "app/terminal/unused_options.h"
#include "app/terminal/wrap.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/answers/run/run.h"
#include "radiosity/engine/solving/shared_stop.h"
#include "radiosity/paper/sampling/rng.h"

#include <atomic>
#include <span>
#include <unistd.h>

namespace hemilux {

namespace {

/// The share of a method's error below which the reference's own error does not matter [-].
constexpr double reference_share = 1.0 / 3;

bool wants_bar(const CompareSettings& settings) {
    return settings.verbosity != Verbosity::quiet && stderr_is_terminal();
}

/// Shows how the reference gets on.
class ReferenceWatcher : public RunWatcher {
  public:
    ReferenceWatcher(const CompareSettings& settings, const StopRule& stop, const Method& method,
                     const Monitor& monitor)
        : verbosity_(settings.verbosity), method_(method),
          progress_(monitor, share_of(stop, method), wants_bar(settings)) {
        progress_.set_topic("reference");
    }
    void step_done(const StepRecord& record, const Solution& /*solution*/) override {
        progress_.step_done(record);
        log_line(verbosity_, Verbosity::verbose,
                 "reference, " + step_text({std::string(method_.name), 0, record, std::nullopt}));
    }

  private:
    Verbosity verbosity_;
    const Method& method_;
    Progress progress_;
};

/// Runs the matrix method until it is good enough or interrupted, with random numbers that no run
/// has. Empty where not even its first step was done.
std::optional<Reference> compute_reference(const CompareSettings& settings,
                                           const std::shared_ptr<const Problem>& problem,
                                           Monitor& monitor) {
    const StopRule stop{.steps = {}, .seconds = {}, .error = settings.reference_error};
    const Method& method = method_of(Role::reference);
    SolveOptions options = settings.options;
    options.literal = false;
    if (!method.work_with(options).estimates_error)
        options.own = {};
    options.seed = hash_words({options.seed, 0x7265666572656e63u});
    ReferenceWatcher watcher(settings, stop, method, monitor);
    Run run = begin(problem, method, std::move(options), false, monitor);
    go_on(run, stop, watcher);
    const Solution& solution = run.solution();
    if (solution.steps == 0)
        return std::nullopt;
    return Reference{solution.radiosity, solution.standard_error, {}};
}

std::vector<MethodRuns> run_with_progress(const Comparison& comparison,
                                          std::optional<SolveError>& fault) {
    std::atomic<double> share_done{0};
    Progress progress(
        comparison.monitor, [&](const ProgressState&) { return share_done.load(); },
        wants_bar(comparison.settings));
    return run_methods(comparison, fault, [&](const StepRow& row, double share) {
        share_done = share;
        const std::string topic = row.method + formatted(", run %u", row.run + 1);
        progress.set_topic(topic);
        log_line(comparison.settings.verbosity, Verbosity::verbose, topic + ", " + step_text(row));
    });
}

/// Finds the light that the reference gives at points of the surfaces; empty where it is not asked
/// for.
std::optional<KnownLight> find_light(const CompareSettings& settings, const Mesh& mesh,
                                     const Tracer& tracer, const Reference& reference,
                                     const StopFlag& interrupted) {
    constexpr std::size_t points = 1 << 15;
    if (!settings.total)
        return std::nullopt;
    const Stage stage("gathering at points", settings.verbosity);
    return std::optional<KnownLight>(std::in_place, mesh, tracer, reference.radiosity, points,
                                     hash_words({settings.options.seed, 0x6c69676874u}),
                                     Workers(settings.options.threads), interrupted);
}

/// Drops methods that were interrupted before their first step, as they have nothing to show.
void drop_empty(std::vector<MethodRuns>& results) {
    for (MethodRuns& result : results)
        std::erase_if(result.runs, [](const MethodRun& run) { return run.rows.empty(); });
    std::erase_if(results, [](const MethodRuns& result) { return result.runs.empty(); });
}

/// Returns a warning where the reference is not much better than what is compared with it; else
/// empty.
std::string reference_warning(double own, std::span<const MethodSummary> summaries) {
    std::vector<std::string> methods;
    for (const MethodSummary& summary : summaries)
        if (own > reference_share * summary.error.all)
            methods.push_back(summary.label + " (" + percent(summary.error.all) + ")");
    return methods.empty()
               ? ""
               : "the reference's own error, " + percent(own) + ", is much of the error of " +
                     joined(methods, ", ") + "; --reference-error asks for a better one";
}

/// Returns all warnings, with those of reading, which were logged before.
std::vector<std::string> page_warnings(const Comparison& comparison, std::string of_reference) {
    std::vector<std::string> all(comparison.warnings.begin(), comparison.warnings.end());
    all.push_back(std::move(of_reference));
    if (comparison.monitor.interrupted)
        all.emplace_back("interrupted; the results are those of the steps that were done");
    std::erase(all, std::string());
    return all;
}

int finish(const Comparison& comparison, std::vector<MethodRuns> results) {
    const Verbosity verbosity = comparison.settings.verbosity;
    if (!comparison.settings.ranks->is_first()) // whose result is the first one's
        return exit_done;
    drop_empty(results);
    WriteReport report;
    if (!results.empty()) {
        const auto summaries = summarise(results, comparison.settings.options.literal);
        const double own = own_error(comparison.mesh, comparison.reference);
        const std::string warning = reference_warning(own, summaries);
        const Stage stage("writing", verbosity);
        report =
            write_comparison(comparison, results, summaries, page_warnings(comparison, warning));
        log_line(verbosity, Verbosity::normal, "the reference's own error: " + percent(own));
        if (!warning.empty())
            log_line(verbosity, Verbosity::normal, "warning: " + warning);
        print(aligned_for(terminal_columns(STDOUT_FILENO), summary_rows(summaries)));
        if (const std::string note = gain_note(summaries); !note.empty())
            log_line(verbosity, Verbosity::normal, note);
    }
    report.log(verbosity);
    if (comparison.monitor.interrupted)
        log_line(verbosity, Verbosity::quiet,
                 results.empty()
                     ? "interrupted before the first step of a method was done"
                     : "interrupted; the results are those of the steps that were done");
    return report.exit_code(bool(comparison.monitor.interrupted));
}

/// Fills in the lines of the faces as soon as they are known.
int run_comparison(CompareSettings settings, std::vector<std::uint32_t>& face_lines) {
    std::vector<const Method*> methods;
    for (const MethodVariant& variant : settings.variants)
        methods.push_back(variant.method);
    const std::size_t variants = methods.size();
    const Method& of_reference = method_of(Role::reference);
    if (!of_reference.work_with(settings.options).estimates_error) // the reference is without it
        check_own_options(settings.options, methods);
    if (settings.reference.empty())
        methods.push_back(&of_reference);
    check_own_options(settings.options, methods);
    warn_of_unused(settings);
    make_folder(settings.folder);
    const RunFiles files = check_files(settings);
    Monitor monitor;
    InterruptGuard guard;
    LoadedMesh loaded = load_mesh(
        settings.scene, files, settings.options, std::span(methods).first(variants),
        settings.verbosity, [&](double) { return bytes_of_compared_pictures(settings.view.size); },
        settings.reference.empty() ? &of_reference : nullptr);
    face_lines = std::move(loaded.face_lines);
    const Mesh& read = loaded.mesh;
    settings.view = view_of(settings.view, loaded.view, settings.verbosity);
    check_camera(settings.view, read, settings.scene.path);
    check_own_options(settings.options, methods, read.patches().size());
    for (const MethodVariant& variant : settings.variants)
        check_variant(variant, settings.options, read.patches().size());
    std::vector<bool> detail = detail_mask(read, settings.detail);
    std::optional<Reference> reference;
    if (!settings.reference.empty())
        reference =
            reference_of(read_patch_table(settings.reference), settings.reference, read, {});
    Prepared prepared = prepare(loaded, settings.options, settings.verbosity);
    const auto problem = std::make_shared<const Problem>(std::move(prepared.problem));
    const Mesh& mesh = *problem->mesh;
    const Tracer& tracer = *problem->tracer;
    guard.watch(monitor.interrupted.own().wished);
    const SharedStop shared_stop(monitor.interrupted, *settings.ranks);
    log_line(settings.verbosity, Verbosity::verbose, tracer_text(problem->tree, prepared.seconds));
    if (!reference)
        reference = compute_reference(settings, problem, monitor);
    if (!reference) {
        log_line(settings.verbosity, Verbosity::quiet, "interrupted before there was a reference");
        return exit_code_of_signal();
    }
    reference->detail = std::move(detail);
    const std::optional<KnownLight> light =
        find_light(settings, mesh, tracer, *reference, monitor.interrupted);
    const Comparison comparison{mesh,
                                tracer,
                                settings,
                                *reference,
                                light ? &*light : nullptr,
                                monitor,
                                problem,
                                loaded.warnings,
                                mean_light(mesh, reference->radiosity),
                                loaded.need.all()};
    if (settings.reference.empty()) {
        const WriteReport report = write_reference(comparison);
        report.log(settings.verbosity);
        if (settings.ranks->any(!report.failed.empty()))
            return exit_output;
    }
    std::optional<SolveError> fault;
    const int code = finish(comparison, run_with_progress(comparison, fault));
    if (fault && code == exit_done)
        throw SolveError(*fault);
    return code;
}

} // namespace

int compare(const CompareSettings& settings) {
    std::vector<std::uint32_t> face_lines;
    try {
        return run_comparison(settings, face_lines);
    } catch (const SolveError& error) {
        throw as_input_error(error, settings.scene.path, face_lines);
    }
}

} // namespace hemilux
