#include "app/commands/compare_outputs.h"

#include "app/rendering/view.h"
#include "app/report/comparison_page.h"
#include "app/report/error_charts.h"
#include "app/settings/names.h"
#include "io/drawings/false_colour.h"
#include "io/files/atomic_file.h"
#include "io/files/error.h"
#include "io/files/input_file.h"
#include "io/pictures/picture_files.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/answers/images/tone.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <unistd.h>

namespace hemilux {

namespace {

namespace fs = std::filesystem;

std::string path_in(const Comparison& comparison, const std::string& name) {
    return (fs::path(comparison.settings.folder) / name).string();
}

std::vector<StepRow> all_rows(std::span<const MethodRuns> results) {
    std::vector<StepRow> rows;
    for (const MethodRuns& result : results)
        for (const MethodRun& run : result.runs)
            rows.insert(rows.end(), run.rows.begin(), run.rows.end());
    return rows;
}

/// Returns the runs of each method as curves of one kind of error.
std::vector<ChartedRuns> charted(std::span<const MethodRuns> results,
                                 std::span<const MethodSummary> summaries, const ErrorKind& kind) {
    std::vector<ChartedRuns> curves;
    for (std::size_t m = 0; m < results.size(); ++m) {
        ChartedRuns& curve = curves.emplace_back(ChartedRuns{summaries[m].label, {}, &kind});
        for (const MethodRun* const run : runs_that_count(results[m]))
            curve.runs.emplace_back(run->rows);
    }
    return curves;
}

Chart chart_of(const Comparison& comparison, std::span<const MethodRuns> results,
               std::span<const MethodSummary> summaries) {
    const CompareSettings& settings = comparison.settings;
    return error_chart(
        fs::path(settings.scene.path).filename().string() + ": " +
            counted(comparison.mesh.patches().size(), "patch", "patches") + ", mean of " +
            counted(settings.runs, "run", "runs"),
        settings.total ? "relative error of the light itself, %" : "relative error, %",
        charted(results, summaries, error_kinds()[settings.total ? total_kind : true_kind]));
}

std::vector<PageChart> page_charts(std::span<const MethodRuns> results,
                                   std::span<const MethodSummary> summaries) {
    std::vector<PageChart> charts;
    for (const ErrorKind& kind : error_kinds())
        if (PageChart chart = page_chart(kind.name, charted(results, summaries, kind));
            !chart.svg.empty())
            charts.push_back(std::move(chart));
    return charts;
}

LitScene lit_by(const Comparison& comparison, std::span<const Vec3> radiosity) {
    return {comparison.mesh, comparison.tracer, radiosity, comparison.settings.options.threads};
}

Camera camera_of(const Comparison& comparison) {
    return camera_of(comparison.settings.view, lit_by(comparison, comparison.reference.radiosity));
}

void write_pictures(const Comparison& comparison, std::span<const MethodRuns> results,
                    WriteReport& report) {
    ViewSettings view = comparison.settings.view;
    const Reference& reference = comparison.reference;
    const Camera camera = camera_of(comparison);
    const RenderOptions options = picture_options(view.size, comparison.settings.options.threads,
                                                  comparison.monitor.interrupted.own().wished);
    const auto picture = [&](std::span<const Vec3> radiosity) {
        return render_view(lit_by(comparison, radiosity), camera, options);
    };
    const Image truth = picture(reference.radiosity);
    choose_exposure(view, truth, lit_by(comparison, reference.radiosity), camera);
    const Display display = display_of(view);
    const auto write = [&](const std::string& name, const Image& image, const Display& shown) {
        const std::string path = path_in(comparison, name);
        report.attempt(path, [&] { write_png(path, image, shown, comparison.settings.from); });
    };
    write("reference.png", truth, display);
    std::vector<std::vector<float>> differences;
    for (const MethodRuns& result : results) {
        const Image image = picture(result.radiosity);
        write(result.variant.file_name() + ".png", image, display);
        differences.push_back(luminance_difference(image, truth, display.exposure));
    }
    const DifferenceScale scale = common_scale(differences);
    for (std::size_t i = 0; i < results.size(); ++i)
        write(results[i].variant.file_name() + "_difference.png",
              false_colour(differences[i], truth.width, truth.height, scale), 1);
}

/// Returns what the numbers of a comparison rest on.
std::vector<std::pair<std::string, std::string>> facts_of(const Comparison& comparison) {
    const CompareSettings& settings = comparison.settings;
    std::vector<std::pair<std::string, std::string>> facts = {
        {"runs of each method", std::to_string(settings.runs)},
        {"seed of the first run", std::to_string(settings.options.seed)},
        {"threads", std::to_string(Workers(settings.options.threads).threads())},
        {"patches", std::to_string(comparison.mesh.patches().size())},
        {"the reference's own error", percent(own_error(comparison.mesh, comparison.reference))}};
    for (const GivenOption& option : settings.given)
        facts.emplace_back(option.name,
                           option.values.empty() ? "yes" : joined(option.values, "  "));
    return facts;
}

void write_page(const Comparison& comparison, std::span<const MethodRuns> results,
                std::span<const MethodSummary> summaries, std::span<const StepRow> rows,
                std::span<const std::string> warnings) {
    const CompareSettings& settings = comparison.settings;
    std::vector<ComparedMethod> methods;
    for (std::size_t m = 0; m < results.size(); ++m)
        methods.push_back(
            {results[m].variant.name, summaries[m].label, results[m].runs.front().lights});
    write_comparison_page(settings.report,
                          {comparison.mesh, comparison.reference.radiosity, comparison.unit,
                           methods, rows, page_charts(results, summaries), summary_rows(summaries),
                           facts_of(comparison), warnings, settings.scene.path,
                           settings.from.command, camera_of(comparison), settings.view.exposure});
}

} // namespace

void make_folder(const std::string& folder) {
    std::error_code failure;
    if (fs::exists(folder, failure) && !fs::is_directory(folder, failure))
        throw OutputError(folder, "is a file; a folder is needed");
    fs::create_directories(folder, failure);
    if (failure)
        throw OutputError(folder, "the folder cannot be made: " + failure.message());
    if (access(folder.c_str(), W_OK | X_OK) != 0)
        throw OutputError(folder,
                          std::string("cannot write to the folder: ") + std::strerror(errno));
}

RunFiles check_files(const CompareSettings& settings) {
    std::vector<std::string> names{"error.csv", "error.svg", "reference.png"};
    for (const MethodVariant& variant : settings.variants)
        for (const char* const end : {".png", "_difference.png"})
            names.push_back(variant.file_name() + end);
    if (settings.reference.empty())
        names.push_back("reference.csv");
    for (std::string& name : names)
        name = (fs::path(settings.folder) / name).string();
    if (!settings.report.empty())
        names.push_back(settings.report);
    RunFiles files = check_files(names, settings.scene.path);
    if (!settings.reference.empty()) {
        files.read("reference", settings.reference);
        check_input(settings.reference, InputKind::stream);
    }
    return files;
}

double own_error(const Mesh& mesh, const Reference& reference) {
    Solution solution;
    solution.radiosity = reference.radiosity;
    solution.standard_error = reference.standard_error;
    return estimated_error(mesh, solution);
}

WriteReport write_comparison(const Comparison& comparison, std::span<const MethodRuns> results,
                             std::span<const MethodSummary> summaries,
                             std::span<const std::string> warnings) {
    WriteReport report;
    const std::string log = path_in(comparison, "error.csv");
    const std::string chart = path_in(comparison, "error.svg");
    const std::vector<StepRow> rows = all_rows(results);
    report.attempt(log, [&] { write_steps_log(log, rows); });
    if (const std::string& page = comparison.settings.report; !page.empty())
        report.attempt(page, [&] { write_page(comparison, results, summaries, rows, warnings); });
    report.attempt(chart, [&] {
        write_atomically(chart, chart_svg(chart_of(comparison, results, summaries)));
    });
    try {
        write_pictures(comparison, results, report);
    } catch (const Interrupted&) {
        report.left_out.push_back(path_in(comparison, "*.png"));
    }
    return report;
}

WriteReport write_reference(const Comparison& comparison) {
    WriteReport report;
    const std::string path = path_in(comparison, "reference.csv");
    report.attempt(path, [&] {
        write_patch_table(path, comparison.mesh, comparison.reference.radiosity,
                          comparison.reference.standard_error,
                          Workers(comparison.settings.options.threads));
    });
    return report;
}

} // namespace hemilux
