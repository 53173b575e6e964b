#include "app/outputs/mesh_output.h"

#include "app/gathering/lit_file_output.h"
#include "app/outputs/layered_picture.h"
#include "app/rendering/view.h"
#include "app/terminal/log.h"
#include "io/meshes/glb.h"
#include "io/pictures/exr.h"
#include "parallel/asked_to_end.h"
#include "parallel/workers.h"
#include "radiosity/answers/lightmaps/lightmap.h"
#include "radiosity/answers/vertices/baked_light.h"
#include "radiosity/answers/vertices/indirect_light.h"
#include "radiosity/answers/views/up_axis.h"
#include "radiosity/paper/sampling/rng.h"

namespace hemilux {
namespace {

/// Returns the light of classes of corners that a mesh shows, which is that of the results or of a
/// layer.
std::vector<Vec3> vertex_light(const SolveSettings& settings, const Results& results,
                               const CornerClasses& classes, const Mesh& mesh,
                               const Solution& solution) {
    if (settings.bake != Bake::indirect)
        return baked_light(mesh, classes, solution, settings.bake);
    const unsigned rays = SolveSettings::bake_rays_per_gather_ray * settings.rays_of_gather();
    return smooth(mesh, classes,
                  indirect_irradiance(
                      mesh, results.tracer, solution.radiosity, rays,
                      hash_words({results.options.seed, 4}), Workers(results.options.threads),
                      [&] { return is_asked_to_end(results.monitor.interrupted.own().wished); }));
}

void write_lightmap(const SolveSettings& settings, const std::string& path, const Image& light,
                    const LampLayers& lamps, std::span<const Image> of_lamps) {
    std::vector<ExrChannel> channels;
    add_half_exr_channels(channels, light);
    add_lamp_channels(channels, lamps, of_lamps);
    write_exr(path, light.width, light.height, std::move(channels), settings.from);
}

/// Returns the lightmaps of layers in a layout; none where they are not gathered.
std::span<const Image> lightmaps_in(const LampLight& lamps, std::size_t layout) {
    return layout < lamps.lightmaps.size() ? lamps.lightmaps[layout] : std::span<const Image>();
}

/// Returns the axis that is upwards; reported where z was guessed.
int up_axis(const ViewSettings& view, const Mesh& mesh, Verbosity verbosity) {
    const std::optional<int> known = view.up ? view.up : view.usual_up;
    const int up = known ? *known : guess_up(mesh);
    if (!known && up == 2)
        log_line(verbosity, Verbosity::normal, "z is taken as upwards; --up y takes y");
    return up;
}

/// Writes a .glb file and its lightmap, each as an attempt of its own: neither's failure takes the
/// other.
void write_lightmapped(const SolveSettings& settings, const std::string& path,
                       const Results& results, const CornerClasses& classes, VertexLight light,
                       int up, WriteReport& report) {
    const Mesh& mesh = results.mesh;
    const int size = *settings.lightmap;
    const std::vector<LightmapChart> charts = find_charts(mesh, size); // which fit: check_lightmap
    const ChartCorners corners = divide_by_charts(mesh, classes, charts);
    const auto of_corners = [&](std::span<const Vec3> of_class) {
        std::vector<Vec3> of_corner;
        for (const std::uint32_t c : corners.class_of)
            of_corner.push_back(of_class[c]);
        return of_corner;
    };
    const auto image_of = [&](std::span<const Vec3> of_class) {
        return lightmap(charts, corners, of_corners(of_class), size);
    };
    report.attempt(lightmap_path(path), [&] {
        if (!results.gathered.lightmaps.empty())
            return write_lightmap(settings, lightmap_path(path),
                                  results.gathered.lightmaps[0].value.image, results.lamps.lamps,
                                  lightmaps_in(results.lamps, 0));
        const Image whole = image_of(light.of_class);
        std::vector<Image> of_lamps =
            of_each_layer(results, [&](const Mesh& lit, const Solution& own) {
                return image_of(vertex_light(settings, results, classes, lit, own));
            });
        add_up(LampShares(results.lamps.lamps), whole, of_lamps);
        write_lightmap(settings, lightmap_path(path), whole, results.lamps.lamps, of_lamps);
    });
    light.of_class = of_corners(light.of_class);
    std::vector<Vec2> texcoords;
    for (const Vec2& place : corners.place)
        texcoords.push_back(place / double(size));
    write_glb(path, mesh, corners.classes, light, settings.from, up, texcoords);
}

} // namespace

void write_mesh(const SolveSettings& settings, const Output& output, const Results& results,
                const CornerClasses& classes, WriteReport& report) {
    VertexLight light{vertex_light(settings, results, classes, results.mesh, results.solution),
                      settings.bake};
    light.display = display_of(settings.view, results.mesh, classes, light.of_class);
    if (output.kind == OutputKind::ply)
        return write_ply(output.path, results.mesh, classes, light, settings.ply_colours);
    const int up = up_axis(settings.view, results.mesh, settings.verbosity);
    if (settings.lightmap)
        write_lightmapped(settings, output.path, results, classes, light, up, report);
    else
        write_glb(output.path, results.mesh, classes, light, settings.from, up);
}

void write_lightmaps(const SolveSettings& settings, const std::string& path,
                     const FileLightmap& file, std::span<const Image> lightmaps,
                     WriteReport& report, const LampLight& lamps) {
    const std::vector<std::string> paths = lightmap_paths(path, file);
    for (std::size_t k = 0; k < paths.size(); ++k)
        report.attempt(paths[k], [&] {
            write_lightmap(settings, paths[k], lightmaps[k], lamps.lamps, lightmaps_in(lamps, k));
        });
}

} // namespace hemilux
