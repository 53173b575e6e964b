// hemilux bake --bake ao: load, gather what blocks the sky, write. Nothing is solved.

#include "app/commands/commands.h"
#include "app/gathering/lightmap_layout.h"
#include "app/gathering/lit_file_output.h"
#include "app/loading/load_geometry.h"
#include "app/outputs/mesh_output.h"
#include "app/outputs/results.h"
#include "app/running/run_files.h"
#include "app/running/signals.h"
#include "app/running/write_report.h"
#include "app/terminal/log.h"
#include "app/terminal/stage.h"
#include "app/terminal/unused_options.h"
#include "io/files/atomic_file.h"
#include "io/files/error.h"
#include "io/results/statistics.h"
#include "parallel/stopwatch.h"
#include "parallel/workers.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/answers/lightmaps/covered_texels.h"
#include "radiosity/answers/lightmaps/occlusion_gather.h"
#include "radiosity/engine/needs/convex_enclosure.h"
#include "radiosity/engine/rays/make_tracer.h"

#include <algorithm>
#include <array>
#include <atomic>

namespace hemilux {

namespace {

/// Shares of the hemisphere to which an object's error is found without --error.
constexpr double default_error = .01;

void warn_of_unused_by_occlusion(const SolveSettings& settings) {
    constexpr const char* light = "the other kinds of --bake";
    const std::array<OptionUse, 4> uses{
        OptionUse{"--gather", false, light}, OptionUse{"--steps", false, light},
        OptionUse{"--exposure", false, light}, OptionUse{"--tone", false, light}};
    warn_of_unused(settings.given, uses, settings.verbosity);
}

OcclusionOptions occlusion_options(const SolveSettings& settings, const Mesh& mesh,
                                   const std::atomic<bool>& interrupted, const Stopwatch& started) {
    OcclusionOptions options{.error = settings.stop.error.value_or(default_error),
                             .seed = settings.options.seed};
    if (settings.file_bake.occlusion_distance)
        options.distance = *settings.file_bake.occlusion_distance * mesh.frame().scale;
    if (settings.stop.rays)
        options.max_rays = *settings.stop.rays;
    options.check = [&interrupted] {
        if (interrupted)
            throw Interrupted();
    };
    options.is_over = [&settings, &interrupted, &started] {
        return interrupted ||
               (settings.stop.seconds && started.seconds() >= *settings.stop.seconds);
    };
    return options;
}

/// Reports the error of the whole, of the object whose error is largest, and with -v of each.
void log_errors(const SolveSettings& settings, const Scene& scene, const Occlusion& found) {
    const auto text_of = [&](const ObjectError& object) {
        return scene.groups[object.group] + " " + percent(object.error) + " by " +
               counted(object.rays, "ray", "rays") + " at each of " +
               counted(object.texels, "texel", "texels");
    };
    const ObjectError all = found.all();
    log_line(settings.verbosity, Verbosity::normal,
             "ambient occlusion: " + counted(all.texels, "texel", "texels") + ", " +
                 short_counted(found.rays, "ray", "rays") + ", error " + percent(all.error) +
                 " of the whole hemisphere (below " + percent(all.bound) + " by 95 %)");
    if (found.objects.empty())
        return;
    const auto worst = std::ranges::max_element(found.objects, {}, &ObjectError::bound);
    log_line(settings.verbosity, Verbosity::normal,
             "the object with the largest error: " + text_of(*worst));
    for (const ObjectError& object : found.objects)
        log_line(settings.verbosity, Verbosity::verbose, "  " + text_of(object));
    const double asked = settings.stop.error.value_or(default_error);
    if (worst->bound > asked)
        log_line(settings.verbosity, Verbosity::normal,
                 "warning: the error asked for, " + percent(asked) +
                     ", is not reached for all objects");
}

/// Returns the rays and the errors of all lightmaps. An object of several is that often in it.
Occlusion all_of(std::span<const Occlusion> found) {
    Occlusion all;
    for (const Occlusion& part : found) {
        all.objects.insert(all.objects.end(), part.objects.begin(), part.objects.end());
        all.rays += part.rays;
    }
    return all;
}

void enter(Statistics& statistics, const SolveSettings& settings, const Mesh& mesh,
           const Occlusion& found) {
    statistics.patches = mesh.patches().size();
    statistics.faces = mesh.scene().faces;
    statistics.materials = mesh.scene().materials.size();
    statistics.method = "ambient occlusion";
    statistics.seed = settings.options.seed;
    statistics.threads = Workers(settings.options.threads).threads();
    statistics.rays_gather = found.rays;
    statistics.estimated_error = found.all().error;
    statistics.error_bound = found.all().bound;
    statistics.estimated_error_of = ErrorOf::gathered;
    for (const ObjectError& object : found.objects)
        statistics.objects.push_back({mesh.scene().groups[object.group], object.texels, object.rays,
                                      object.error, object.bound});
    statistics.program = settings.from.program;
    statistics.settings = settings.given;
}

WriteReport write(const SolveSettings& settings, const Mesh& mesh, const FileLightmap& file,
                  std::span<const Image> lightmaps, Statistics& statistics,
                  const Stopwatch& started) {
    WriteReport report;
    const std::string& path = settings.outputs.front().path;
    const Stopwatch writing;
    report.attempt(path, [&] { write_lit_file(settings, path, mesh, file, lightmaps); });
    write_lightmaps(settings, path, file, lightmaps, report);
    statistics.seconds_write = writing.seconds();
    statistics.seconds_total = started.seconds();
    statistics.bytes_peak = peak_memory_bytes();
    if (!settings.statistics.empty())
        report.attempt(settings.statistics,
                       [&] { write_atomically(settings.statistics, to_json(statistics)); });
    return report;
}

} // namespace

int bake_occlusion(const SolveSettings& settings) {
    const Stopwatch started;
    Monitor monitor;
    InterruptGuard guard;
    const RunFiles files = check_files(settings);
    warn_of_unused_by_occlusion(settings);
    const GeometryUse use{[&](double patches) {
                              return bytes_of_own_file(settings) +
                                     bytes_of_results(settings, patches);
                          },
                          "a smaller --lightmap needs less"};
    LoadedGeometry loaded =
        load_geometry(settings.scene, files, settings.options, use, settings.verbosity);
    const Mesh& mesh = loaded.mesh;
    FileLightmap file =
        lightmap_of_file(settings, mesh, std::move(loaded.origins), loaded.warnings);
    Statistics statistics;
    statistics.seconds_read = started.seconds();
    const Stopwatch building;
    const MadeTracer made = make_tracer(mesh, settings.options.threads);
    statistics.seconds_bvh = building.seconds();
    const std::atomic<bool>& interrupted = monitor.interrupted.own().wished;
    guard.watch(monitor.interrupted.own().wished);
    const Workers workers(settings.options.threads);
    OcclusionOptions options = occlusion_options(settings, mesh, interrupted, started);
    std::optional<Stage> stage(std::in_place, "gathering the occlusion", settings.verbosity);
    const Stopwatch gathering;
    std::vector<Occlusion> found;
    std::vector<Image> lightmaps;
    try {
        for (const ObjectLightmap& part : file.parts) {
            const TexelMap texels =
                texels_of(part.layout, part.layout.triangles, mesh, *made.tracer);
            const std::vector<bool> covered =
                find_covered(mesh, *made.tracer, texels, options.check, workers);
            Occlusion& of_part = found.emplace_back(
                gather_occlusion(mesh, *made.tracer, texels, covered, options, workers));
            fill_texels(of_part.lightmap, texels, part.layout.margin);
            lightmaps.push_back(std::move(of_part.lightmap.image));
            options.max_rays -= std::min(options.max_rays, of_part.rays);
        }
    } catch (const Interrupted&) {
        stage.reset();
        log_line(settings.verbosity, Verbosity::quiet, "interrupted; nothing was written");
        return exit_code_of_signal();
    }
    const Occlusion all = all_of(found);
    statistics.seconds_gather = gathering.seconds();
    stage.reset();
    log_errors(settings, mesh.scene(), all);
    enter(statistics, settings, mesh, all);
    const WriteReport report = write(settings, mesh, file, lightmaps, statistics, started);
    report.log(settings.verbosity);
    const bool ended(interrupted);
    report.log_interruption(settings.verbosity, ended);
    return report.exit_code(ended);
}

} // namespace hemilux
