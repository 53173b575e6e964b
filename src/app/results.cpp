#include "app/results.h"

#include "app/exit_code.h"
#include "app/view.h"
#include "io/image.h"
#include "io/ply.h"
#include "io/smooth.h"
#include "radiosity/workers.h"

#include <algorithm>
#include <mutex>
#include <optional>

namespace hemilux {

namespace {

/// Found when they are first asked for, once for pictures and meshes.
class SharedClasses {
  public:
    explicit SharedClasses(const Mesh& mesh) : mesh_(mesh) {}
    const CornerClasses& get() {
        std::call_once(found_, [&] { classes_ = find_corner_classes(mesh_); });
        return classes_;
    }

  private:
    const Mesh& mesh_;
    std::once_flag found_;
    CornerClasses classes_;
};

/// Renders when the first picture is asked for, and once only.
class Picture {
  public:
    Picture(const ViewSettings& view, const Results& results, SharedClasses& classes)
        : view_(view), results_(results), classes_(classes) {}

    void write(const Output& output) {
        if (!image_)
            image_ = render();
        if (output.kind == OutputKind::hdr)
            write_hdr(output.path, *image_);
        else
            write_png(output.path, *image_, exposure_of(view_, *image_));
    }

  private:
    [[nodiscard]] Image render() const {
        const auto& [mesh, tracer, solution, statistics, steps] = results_;
        const Camera camera = camera_of(view_, mesh, tracer, solution.radiosity);
        return render_view(view_, mesh, tracer, solution.radiosity, camera, statistics.threads,
                           &classes_.get());
    }

    const ViewSettings& view_;
    const Results& results_;
    SharedClasses& classes_;
    std::optional<Image> image_;
};

void write_output(const Output& output, const Results& results, SharedClasses& classes,
                  Picture& picture) {
    const Solution& solution = results.solution;
    switch (output.kind) {
    case OutputKind::png:
    case OutputKind::hdr:
        return picture.write(output);
    case OutputKind::ply:
        return write_ply(output.path, results.mesh, solution.radiosity, classes.get());
    case OutputKind::csv:
        return write_patch_table(output.path, results.mesh, solution.radiosity,
                                 solution.standard_error, Workers(results.statistics.threads));
    case OutputKind::json:
        return write_statistics(output.path, results.statistics);
    }
}

} // namespace

std::vector<std::string> output_paths(const SolveSettings& settings) {
    std::vector<std::string> paths;
    for (const Output& output : settings.outputs)
        paths.push_back(output.path);
    for (const std::string& path : {settings.statistics, settings.steps_log})
        if (!path.empty())
            paths.push_back(path);
    return paths;
}

void check_outputs(const SolveSettings& settings) {
    std::vector<std::string> paths = output_paths(settings);
    if (paths.empty())
        throw UsageError("nothing would be written; add an output such as -o picture.png");
    if (settings.every_step && std::ranges::none_of(settings.outputs, is_picture, &Output::kind))
        throw UsageError("--every-step is for pictures; add -o picture.png");
    const CheckpointSettings& checkpoint = settings.checkpoint;
    if (!checkpoint.path.empty())
        paths.push_back(checkpoint.path);
    if (checkpoint.resumed != checkpoint.path && !checkpoint.resumed.empty())
        paths.push_back(checkpoint.resumed);
    for (const std::string& read : {settings.scene.path, settings.reference}) {
        std::vector<std::string> with_it = paths;
        if (!read.empty())
            with_it.push_back(read); // must not be overwritten
        check_distinct(with_it);
    }
    for (const std::string& path : output_paths(settings))
        check_writable(path);
    if (!checkpoint.path.empty())
        check_writable(checkpoint.path);
}

WriteReport write_results(const SolveSettings& settings, const Results& results) {
    SharedClasses classes(results.mesh);
    Picture picture(settings.view, results, classes);
    std::vector<WriteReport> reports(settings.outputs.size());
    const auto write = [&](std::size_t k) {
        const Output& output = settings.outputs[k];
        reports[k].attempt(output.path, [&] { write_output(output, results, classes, picture); });
    };
    // All pictures are one, made by all threads; meanwhile each of the tables has one.
    std::vector<std::vector<std::size_t>> jobs(1);
    for (std::size_t k = 0; k < settings.outputs.size(); ++k)
        if (is_picture(settings.outputs[k].kind))
            jobs[0].push_back(k);
        else
            jobs.push_back({k});
    Workers(settings.options.threads).for_chunks(jobs.size(), 1, [&](std::size_t job, std::size_t) {
        std::ranges::for_each(jobs[job], write);
    });
    WriteReport report;
    for (const WriteReport& of_output : reports)
        report.add(of_output);
    if (!settings.statistics.empty())
        report.attempt(settings.statistics,
                       [&] { write_statistics(settings.statistics, results.statistics); });
    if (!settings.steps_log.empty())
        report.attempt(settings.steps_log,
                       [&] { write_steps_log(settings.steps_log, results.steps); });
    return report;
}

} // namespace hemilux
