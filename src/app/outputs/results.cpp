#include "app/outputs/results.h"

#include "app/gathering/lit_file_output.h"
#include "app/gathering/point_table.h"
#include "app/gathering/shown_camera.h"
#include "app/outputs/error_map.h"
#include "app/outputs/layered_picture.h"
#include "app/outputs/mesh_output.h"
#include "app/rendering/view.h"
#include "app/report/report_page.h"
#include "app/terminal/log.h"
#include "io/files/atomic_file.h"
#include "io/files/error.h"
#include "io/files/provenance.h"
#include "io/meshes/vtu.h"
#include "io/pictures/exr.h"
#include "parallel/workers.h"
#include "radiosity/answers/images/image.h"
#include "radiosity/answers/picture_check/picture_check.h"
#include "radiosity/answers/vertices/smooth.h"
#include "radiosity/engine/densities/density.h"
#include "radiosity/engine/shooting/guide.h"

#include <algorithm>
#include <mutex>
#include <numeric>
#include <optional>

namespace hemilux {

namespace {

/// The classes of corners, found when they are first asked for, once for pictures and meshes.
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

/// The picture of the light. It is rendered when the first picture is asked for, and once only.
class Picture {
  public:
    /// A picture that does not gather interpolates.
    Picture(const ViewSettings& view, bool gathers, const Results& results, SharedClasses& classes)
        : view_(view), gathers_(gathers), results_(results), classes_(classes) {}

    void write(const Output& output, const Provenance& from, Verbosity verbosity) {
        if (!image_)
            image_ = render(verbosity);
        if (output.kind == OutputKind::exr)
            write_exr(output.path, image_->width, image_->height,
                      picture_layers(results_, *image_, of_lamps(), camera_), from);
        else
            write_picture(output, *image_, view_, from);
    }

  private:
    [[nodiscard]] Image render(Verbosity verbosity) {
        const LitScene scene = results_.lit();
        camera_ = shown_camera_of(view_, scene, verbosity);
        if (gathers_ && !results_.gathered.picture)
            log_line(verbosity, Verbosity::quiet,
                     "interrupted; pictures show the light of the patches" +
                         squares_text(view_.size));
        Image image = results_.gathered.picture && gathers_
                          ? results_.gathered.picture->value.image
                          : interpolated(scene, results_.solution);
        choose_exposure(view_, image, scene, camera_,
                        pixels_in_time(results_.monitor.interrupted.own().wished));
        if (!results_.monitor.interrupted.own().wished)
            warn_of_picture(image, scene, verbosity);
        return image;
    }

    /// Says why a picture shows nothing.
    void warn_of_picture(const Image& image, const LitScene& scene, Verbosity verbosity) const {
        const std::string text = picture_warning(
            {image, display_of(view_), scene.mesh, scene.tracer, scene.radiosity, camera_});
        if (!text.empty())
            log_line(verbosity, Verbosity::normal, "warning: " + text);
    }

    [[nodiscard]] Image interpolated(const LitScene& scene, const Solution& solution) {
        RenderOptions options =
            picture_options(view_.size, scene.threads, results_.monitor.interrupted.own().wished);
        options.classes = &classes_.get();
        options.slope = solution.slope;
        return render_view(scene, camera_, options);
    }

    /// Returns the picture by each lamp, in its layer.
    [[nodiscard]] std::vector<Image> of_lamps() {
        const LampLight& light = results_.lamps;
        if (light.patches.empty() || !light.pictures.empty())
            return light.pictures;
        std::vector<Image> images =
            of_each_layer(results_, [&](const Mesh& lit, const Solution& own) {
                return interpolated({lit, results_.tracer, own.radiosity, results_.options.threads},
                                    own);
            });
        add_up(LampShares(light.lamps), *image_, images);
        return images;
    }

    ViewSettings view_;
    bool gathers_;
    const Results& results_;
    SharedClasses& classes_;
    std::optional<Image> image_;
    Camera camera_; ///< of the image
};

/// Returns the columns of layers: of the light of patches, with the lamp that each is of.
csv::MoreColumns columns_of_patches(const Results& results) {
    const LampLight& light = results.lamps;
    if (light.patches.empty())
        return {};
    csv::MoreColumns columns{
        "lamp", [&](std::size_t patch) -> std::string_view {
            const std::uint32_t lamp = light.lamps.of_facet[results.mesh.patches()[patch].facet];
            return lamp == none ? std::string_view() : light.lamps.layers[lamp].name;
        }};
    for (std::size_t k = 0; k < light.patches.size(); ++k) {
        const Relit& layer = light.patches[k];
        const std::string& name = light.lamps.layers[k].name;
        columns.colours.push_back({name, [&](std::size_t i) { return layer.radiosity[i]; }});
        columns.colours.push_back(
            {name + ".stderr", [&](std::size_t i) { return layer.standard_error[i]; }});
    }
    return columns;
}

/// Returns the columns of layers, of the irradiance at points.
csv::MoreColumns columns_of_points(const LampLight& light) {
    csv::MoreColumns columns;
    for (std::size_t k = 0; k < light.points.size(); ++k) {
        const std::vector<PointLight>& points = light.points[k];
        const std::string& name = light.lamps.layers[k].name;
        columns.colours.push_back({name, [&](std::size_t i) { return points[i].irradiance; }});
        columns.colours.push_back(
            {name + ".stderr", [&](std::size_t i) { return points[i].standard_error; }});
    }
    return columns;
}

void write_gathered_file(const SolveSettings& settings, const std::string& path,
                         const Results& results, WriteReport& report) {
    if (results.gathered.lightmaps.empty())
        throw Interrupted();
    std::vector<Image> lightmaps;
    for (const Answer<LightOfLightmap>& lightmap : results.gathered.lightmaps)
        lightmaps.push_back(lightmap.value.image);
    write_lit_file(settings, path, results.mesh, results.file_lightmap, lightmaps);
    write_lightmaps(settings, path, results.file_lightmap, lightmaps, report, results.lamps);
}

void write_output(const SolveSettings& settings, const Output& output, const Results& results,
                  SharedClasses& classes, Picture& picture, WriteReport& report) {
    const Solution& solution = results.solution;
    switch (output.kind) {
    case OutputKind::png:
    case OutputKind::hdr:
    case OutputKind::exr:
        return picture.write(output, settings.from, settings.verbosity);
    case OutputKind::ply:
    case OutputKind::obj:
    case OutputKind::glb:
        if (settings.file_bake.asked)
            return write_gathered_file(settings, output.path, results, report);
        return write_mesh(settings, output, results, classes.get(), report);
    case OutputKind::vtu:
        return write_vtu(output.path, results.mesh, classes.get(), solution, settings.from);
    case OutputKind::csv:
        return write_patch_table(output.path, results.mesh, solution.radiosity,
                                 solution.standard_error, Workers(results.options.threads),
                                 solution.slope, solution.weight, columns_of_patches(results));
    case OutputKind::json:
        return write_atomically(output.path, to_json(results.statistics));
    }
}

void write_report(const SolveSettings& settings, const Results& results) {
    const SolveOptions& options = results.options;
    ReportContent content{results.mesh,           results.solution,
                          results.statistics,     results.steps,
                          results.warnings,       settings.scene.path,
                          settings.from.command,  camera_of(settings.view, results.lit()),
                          settings.view.exposure, results.lights,
                          results.unit,           results.lamps};
    const bool by_densities =
        settings.method->role == Role::paper && !guide_of(options) && !settings.plain;
    if (!by_densities)
        return write_report_page(settings.report, content);
    // The densities are counted again, as the method does not keep all.
    const Hemisphere hemisphere(options.depth);
    const DensityMap map(results.mesh, results.tracer, hemisphere, options.threshold,
                         Workers(options.threads), results.monitor);
    const ReportDensities densities{hemisphere, map, options.threshold};
    if (!results.monitor.interrupted)
        content.densities = &densities;
    write_report_page(settings.report, content);
}

} // namespace

bool shows_statistics(const SolveSettings& settings) {
    return settings.verbosity != Verbosity::quiet || !settings.statistics.empty() ||
           !settings.report.empty() ||
           std::ranges::find(settings.outputs, OutputKind::json, &Output::kind) !=
               settings.outputs.end();
}

WriteReport write_results(const SolveSettings& settings, const Results& results,
                          const Stopwatch& started) {
    Statistics& statistics = results.statistics;
    statistics.program = settings.from.program;
    statistics.settings = settings.given;
    const Stopwatch writing;
    SharedClasses classes(results.mesh);
    Picture picture(settings.view, settings.gather_pictures && results.gathered.was_wanted, results,
                    classes);
    WriteReport report;
    if (!settings.points.output.empty())
        report.attempt(settings.points.output, [&] {
            write_points(settings.points.output, results.mesh, results.points, results.gathered,
                         Workers(results.options.threads), columns_of_points(results.lamps));
        });
    const double seconds_points = writing.seconds();
    std::vector<WriteReport> reports(settings.outputs.size());
    const auto write = [&](std::size_t k) {
        const Output& output = settings.outputs[k];
        reports[k].attempt(output.path, [&] {
            write_output(settings, output, results, classes, picture, reports[k]);
        });
    };
    // All pictures are one, made by all threads; meanwhile each of the tables has one. A single
    // thread writes the tables first, as a signal may end the pictures.
    std::vector<std::vector<std::size_t>> jobs(1);
    for (std::size_t k = 0; k < settings.outputs.size(); ++k)
        if (is_picture(settings.outputs[k].kind))
            jobs[0].push_back(k);
        else if (settings.outputs[k].kind != OutputKind::json)
            jobs.push_back({k});
    std::vector<double> seconds(jobs.size());
    const Workers workers(settings.options.threads);
    const bool reversed = workers.threads() == 1;
    workers.for_chunks(jobs.size(), 1, [&](std::size_t turn, std::size_t) {
        const std::size_t job = reversed ? jobs.size() - 1 - turn : turn;
        const Stopwatch watch;
        std::ranges::for_each(jobs[job], write);
        seconds[job] = watch.seconds();
    });
    double seconds_map = 0;
    if (!settings.error_map.empty()) {
        const Stopwatch watch;
        report.attempt(settings.error_map,
                       [&] { write_error_map(settings.error_map, settings.view, results); });
        seconds_map = watch.seconds();
    }
    // What is done side by side shares the time.
    const double sum = std::accumulate(seconds.begin(), seconds.end(), 0.0);
    const double share = sum > 0 ? (writing.seconds() - seconds_points - seconds_map) / sum : 0;
    statistics.seconds_picture = seconds_map + share * seconds[0];
    statistics.seconds_write = seconds_points + share * (sum - seconds[0]);
    statistics.bytes_peak = peak_memory_bytes();
    statistics.seconds_total = started.seconds();
    for (std::size_t k = 0; k < settings.outputs.size(); ++k)
        if (settings.outputs[k].kind == OutputKind::json)
            write(k);
    for (const WriteReport& of_output : reports)
        report.add(of_output);
    if (!settings.statistics.empty())
        report.attempt(settings.statistics,
                       [&] { write_atomically(settings.statistics, to_json(results.statistics)); });
    if (!settings.steps_log.empty())
        report.attempt(settings.steps_log,
                       [&] { write_steps_log(settings.steps_log, results.steps); });
    if (!settings.report.empty())
        report.attempt(settings.report, [&] { write_report(settings, results); });
    return report;
}

} // namespace hemilux
