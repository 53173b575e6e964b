#include "app/running/results.h"

#include "app/settings/exit_code.h"
#include "app/settings/view.h"
#include "io/files/error.h"
#include "io/files/input_file.h"
#include "io/pictures/image.h"
#include "io/results/ply.h"
#include "io/results/smooth.h"
#include "radiosity/sampling/workers.h"

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
        : view_(view), results_(results), classes_(classes), time_(results.interrupted) {}

    void write(const Output& output) {
        if (!image_)
            image_ = render();
        if (time_.is_over())
            throw Interrupted();
        if (output.kind == OutputKind::hdr)
            write_hdr(output.path, *image_);
        else
            write_png(output.path, *image_, exposure_of(view_, *image_));
    }

  private:
    [[nodiscard]] Image render() const {
        const auto& [mesh, tracer, solution, statistics, steps, interrupted] = results_;
        const Camera camera = camera_of(view_, mesh, tracer, solution.radiosity);
        return render_view(view_, mesh, tracer, solution.radiosity, camera, statistics.threads,
                           time_, &classes_.get(), solution.slope);
    }

    const ViewSettings& view_;
    const Results& results_;
    SharedClasses& classes_;
    PictureTime time_;
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
        return write_ply(output.path, results.mesh, solution.radiosity, classes.get(),
                         solution.slope);
    case OutputKind::csv:
        return write_patch_table(output.path, results.mesh, solution.radiosity,
                                 solution.standard_error, Workers(results.statistics.threads),
                                 solution.slope);
    case OutputKind::json:
        return write_statistics(output.path, results.statistics);
    }
}

} // namespace

RunFiles check_files(const SolveSettings& settings) {
    std::vector<std::pair<std::string, std::string>> written;
    for (const Output& output : settings.outputs)
        written.emplace_back("output", output.path);
    for (const auto& [role, path] : {std::pair("file of --stats", settings.statistics),
                                     std::pair("file of --steps-log", settings.steps_log)})
        if (!path.empty())
            written.emplace_back(role, path);
    if (written.empty())
        throw UsageError("nothing would be written; add an output such as -o picture.png");
    if (settings.every_step && std::ranges::none_of(settings.outputs, is_picture, &Output::kind))
        throw UsageError("--every-step is for pictures; add -o picture.png");
    const auto& [checkpoint, resumed, every] = settings.checkpoint;
    if (!checkpoint.empty())
        written.emplace_back("checkpoint", checkpoint);
    RunFiles files;
    for (const auto& [role, path] : written)
        files.write(role, path);
    for (const Output& output : settings.outputs)
        if (settings.every_step && is_picture(output.kind))
            files.write_steps(output.path);
    files.read("scene", settings.scene.path);
    if (!settings.reference.empty())
        files.read("reference", settings.reference);
    // A run may renew the checkpoint that it goes on from.
    if (!resumed.empty() && resumed != checkpoint &&
        identity_of(resumed) != identity_of(checkpoint))
        files.read("file of --resume", resumed);
    for (const auto& [role, path] : written)
        check_writable(path);
    if (!settings.reference.empty())
        check_input(settings.reference, InputKind::stream);
    return files;
}

WriteReport write_results(const SolveSettings& settings, const Results& results) {
    SharedClasses classes(results.mesh);
    Picture picture(settings.view, results, classes);
    std::vector<WriteReport> reports(settings.outputs.size());
    const auto write = [&](std::size_t k) {
        const Output& output = settings.outputs[k];
        reports[k].attempt(output.path, [&] { write_output(output, results, classes, picture); });
    };
    // All pictures are one, made by all threads; meanwhile each of the tables has one. A single
    // thread writes the tables first, as a signal may end the pictures.
    std::vector<std::vector<std::size_t>> jobs(1);
    for (std::size_t k = 0; k < settings.outputs.size(); ++k)
        if (is_picture(settings.outputs[k].kind))
            jobs[0].push_back(k);
        else
            jobs.push_back({k});
    const Workers workers(settings.options.threads);
    if (workers.threads() == 1)
        std::ranges::reverse(jobs);
    workers.for_chunks(jobs.size(), 1, [&](std::size_t job, std::size_t) {
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
