// hemilux density: what preprocessing found (paper section 5a, or 4), as drawings.

#include "app/commands/commands.h"
#include "app/commands/divided_hemispheres.h"
#include "app/loading/load.h"
#include "app/loading/load_geometry.h"
#include "app/memory/memory.h"
#include "app/rendering/view.h"
#include "app/running/signals.h"
#include "app/running/write_report.h"
#include "app/settings/exit_code.h"
#include "app/settings/extension.h"
#include "app/settings/method_options.h"
#include "app/terminal/log.h"
#include "app/terminal/stage.h"
#include "app/terminal/unused_options.h"
#include "bvh/wide/wide_bvh.h"
#include "io/drawings/density_picture.h"
#include "io/drawings/plane_svg.h"
#include "io/files/atomic_file.h"
#include "io/pictures/picture_files.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/engine/densities/subdivision_1997.h"
#include "radiosity/engine/shooting/guide.h"
#include "radiosity/engine/solving/own_options.h"
#include "radiosity/paper/hemisphere/hemisphere.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace hemilux {

namespace {

/// The data that the drawings are made from.
struct Preprocessed {
    const DensitySettings& settings;
    const Mesh& mesh;
    const Tracer& tracer;
    const DividedHemispheres& hemispheres;
    Monitor& monitor;
};

/// The mean and the standard deviation of each patch's densities, weighted by the power of their
/// triangles. The mean is D_average of the paper. Parts of a patch count alike.
struct PatchDensities {
    std::vector<double> mean, spread;
};

PatchDensities summarise(const Preprocessed& made) {
    PatchDensities result;
    const std::size_t parts = made.hemispheres.parts();
    for (std::uint32_t i = 0; i < made.mesh.patches().size(); ++i) {
        double mean = 0, square = 0;
        for (std::size_t part = 0; part < parts; ++part)
            for (const DrawnTriangle& triangle : made.hemispheres.triangles(i, part)) {
                const double share = std::max(triangle.shape.projected_solid_angle(), 0.0) /
                                     (std::numbers::pi * double(parts));
                mean += share * triangle.density;
                square += share * triangle.density * triangle.density;
            }
        result.mean.push_back(mean);
        result.spread.push_back(std::sqrt(std::max(0.0, square - mean * mean)));
    }
    return result;
}

std::uint32_t patch_to_draw(const Preprocessed& made, const PatchDensities& densities) {
    const DensitySettings& settings = made.settings;
    if (settings.patch)
        return *settings.patch;
    const auto largest = std::ranges::max_element(densities.spread);
    const auto patch = static_cast<std::uint32_t>(largest - densities.spread.begin());
    log_line(
        settings.verbosity, Verbosity::normal,
        formatted("patch %u has the largest spread of densities; --patch draws another", patch));
    return patch;
}

std::string title_of(const Preprocessed& made, std::uint32_t patch, double mean,
                     std::size_t triangles) {
    const Scene& scene = made.mesh.scene();
    const Facet& facet = scene.facets[made.mesh.patches()[patch].facet];
    return formatted("patch %u (", patch) + scene.materials[facet.material].name + ", " +
           scene.groups[facet.group] + "): " +
           (made.hemispheres.parts() > 1 ? formatted("part %u, ", made.settings.part) : "") +
           counted(triangles, "triangle", "triangles") + formatted(", mean density %.3g", mean);
}

/// Returns the hemispheres of a patch, each over its part where the patch has several.
std::vector<HemisphereDrawing::Part> parts_of(const Preprocessed& made, std::uint32_t patch) {
    const std::size_t parts = made.hemispheres.parts();
    std::vector<HemisphereDrawing::Part> result;
    const Frame frame = made.mesh.hemisphere_frame(patch);
    const Patch& whole = made.mesh.patches()[patch];
    for (std::size_t part = 0; parts > 1 && part < parts; ++part) {
        Polygon outline = part_of(whole.shape, parts, part);
        for (Vec3& corner : outline.corner)
            corner = frame.to_local(corner - whole.centre);
        result.push_back({outline, made.hemispheres.triangles(patch, part)});
    }
    return result;
}

/// Writes figure 1.
void write_plane(const Preprocessed& made, const PatchDensities& densities, std::uint32_t patch,
                 const std::string& path) {
    const std::size_t part = made.settings.part;
    const Vec3 centre =
        part_of(made.mesh.patches()[patch].shape, made.hemispheres.parts(), part).centre();
    const std::size_t triangles = made.hemispheres.triangles(patch, part).size();
    write_atomically(path, plane_svg({title_of(made, patch, densities.mean[patch], triangles),
                                      made.hemispheres.counted(patch, part),
                                      cut_by_plane(made.mesh, patch, centre)}));
}

void write_hemisphere(const Preprocessed& made, const PatchDensities& densities,
                      std::uint32_t patch, const std::string& path) {
    const std::size_t part = made.settings.part;
    const std::uint32_t rays = made.settings.rays;
    HemisphereDrawing drawing{{},
                              made.hemispheres.triangles(patch, part),
                              made.hemispheres.counted(patch, part),
                              rays > 0 ? made.hemispheres.rays(patch, part, rays)
                                       : std::vector<Vec3>{},
                              parts_of(made, patch),
                              made.hemispheres.unit()};
    drawing.title = title_of(made, patch, densities.mean[patch], drawing.triangles.size());
    write_atomically(path, hemisphere_svg(drawing));
}

void write_picture(const Preprocessed& made, const PatchDensities& densities,
                   const std::string& path) {
    const ViewSettings& view = made.settings.view;
    std::vector<Vec3> light; // for the choice of a camera: everything is lit
    for (const double mean : densities.mean)
        light.emplace_back(1 + mean);
    const unsigned threads = made.settings.options.threads;
    const Camera camera = camera_of(view, {made.mesh, made.tracer, light, threads});
    write_png(path,
              render_in_time(
                  picture_options(view.size, threads, made.monitor.interrupted.own().wished),
                  [&](const RenderOptions& options) {
                      return density_picture(made.mesh, made.tracer, densities.mean,
                                             "mean density of patches, " + made.hemispheres.unit(),
                                             camera, options);
                  }),
              1);
}

bool is_svg(const std::string& path) { return extension_of(path) == ".svg"; }

void check(const DensitySettings& settings) {
    const bool draws = std::ranges::any_of(settings.outputs, is_svg);
    if (!draws && (settings.patch || settings.rays > 0 || settings.plane))
        throw UsageError("--patch, --rays and --plane are for .svg outputs, and there is none");
    check_own_options(settings.options, {&settings.method, 1});
    const bool has_parts = settings.method == &method_of(Role::forerunner);
    const Guide* const guide = own_options<GuideChoice>(settings.options).guide;
    if (guide && settings.plane)
        throw UsageError("--plane shows rays that count, and --guide " + std::string(guide->name) +
                         " has none");
    const std::uint32_t parts =
        has_parts ? own_options<Subdivision1997Options>(settings.options).parts : 1;
    if (settings.part >= parts)
        throw UsageError(formatted("--part: there is no part %u; they are numbered from 0 to %u",
                                   settings.part, parts - 1));
}

void check_patch(const DensitySettings& settings, const Mesh& mesh) {
    const std::size_t patches = mesh.patches().size();
    if (settings.patch && *settings.patch >= patches)
        throw UsageError(formatted("--patch: there is no patch %u; they are numbered from 0 to %zu",
                                   *settings.patch, patches - 1));
}

/// Returns the bytes of the densities of so many patches, and of the drawings.
double bytes_of_drawings(const DensitySettings& settings, double patches) {
    constexpr double per_patch = 32, per_triangle = 8000, per_ray = 1000, per_pixel = 36;
    constexpr double of_hemisphere = 4e6;
    const bool has_parts = settings.method == &method_of(Role::forerunner);
    const Subdivision1997Options& own = own_options<Subdivision1997Options>(settings.options);
    double bytes = of_hemisphere + per_patch * patches;
    if (settings.method->bytes)
        bytes += settings.method->bytes(settings.options, patches);
    if (std::ranges::any_of(settings.outputs, is_svg)) {
        const auto triangles =
            has_parts ? double(own.parts) * double(Subdivision1997::triangles(static_cast<int>(
                                                own.stored_steps + own.estimated_steps)))
                      : double(Hemisphere::cells_up_to(settings.options.depth));
        bytes += per_triangle * triangles + per_ray * settings.rays;
    }
    if (!std::ranges::all_of(settings.outputs, is_svg))
        bytes += bytes_of_picture(settings.view.size, false, 1) +
                 per_pixel * double(settings.view.size.width) * settings.view.size.height;
    return bytes;
}

void log_summary(const Preprocessed& made, const PatchDensities& densities) {
    const auto [least, most] = std::ranges::minmax(densities.mean);
    log_line(made.settings.verbosity, Verbosity::normal,
             counted(densities.mean.size(), "patch", "patches") + ", " +
                 short_count(static_cast<double>(made.hemispheres.density_rays())) +
                 " density rays, " + byte_size(made.hemispheres.bytes()) +
                 formatted("; mean density of a patch %.3g to %.3g", least, most));
}

} // namespace

int density(DensitySettings settings) {
    const RunFiles files = check_files(settings.outputs, settings.scene.path);
    check(settings);
    const bool draws_pictures = !std::ranges::all_of(settings.outputs, is_svg);
    const std::array<OptionUse, 2> uses{
        {{"--camera", draws_pictures, ".png outputs"}, {"--size", draws_pictures, ".png outputs"}}};
    warn_of_unused(settings.given, uses, settings.verbosity);
    Monitor monitor;
    InterruptGuard guard;
    const GeometryUse use{[&](double patches) { return bytes_of_drawings(settings, patches); },
                          "a larger --max-edge, a smaller --depth and a smaller --size need less"};
    const auto [mesh, view, origins, warnings] =
        load_geometry(settings.scene, files, settings.options, use, settings.verbosity);
    if (draws_pictures)
        settings.view = view_of(settings.view, view, settings.verbosity);
    check_camera(settings.view, mesh, settings.scene.path);
    check_patch(settings, mesh);
    const WideBvh bvh(mesh.soup_to_trace(), {.threads = settings.options.threads});
    guard.watch(monitor.interrupted.own().wished);
    std::optional<Stage> stage(std::in_place, "dividing hemispheres", settings.verbosity);
    const auto hemispheres = divide_hemispheres(settings, mesh, bvh, monitor);
    if (monitor.interrupted) {
        log_line(settings.verbosity, Verbosity::quiet, "interrupted; nothing was written");
        return exit_code_of_signal();
    }
    const Preprocessed made{settings, mesh, bvh, *hemispheres, monitor};
    const PatchDensities densities = summarise(made);
    log_summary(made, densities);
    std::optional<std::uint32_t> patch;
    if (std::ranges::any_of(settings.outputs, is_svg))
        patch = patch_to_draw(made, densities);
    stage.reset();
    stage.emplace("writing", settings.verbosity);
    WriteReport report;
    for (const std::string& path : settings.outputs)
        report.attempt(path, [&] {
            if (is_svg(path) && settings.plane)
                write_plane(made, densities, *patch, path);
            else if (is_svg(path))
                write_hemisphere(made, densities, *patch, path);
            else
                write_picture(made, densities, path);
        });
    const bool interrupted(monitor.interrupted);
    report.log(settings.verbosity);
    report.log_interruption(settings.verbosity, interrupted);
    return report.exit_code(interrupted);
}

} // namespace hemilux
