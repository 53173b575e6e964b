#include "app/commands/density.h"

#include "app/loading/load_geometry.h"
#include "app/running/signals.h"
#include "app/running/write_report.h"
#include "app/settings/exit_code.h"
#include "app/settings/extension.h"
#include "app/settings/text.h"
#include "app/settings/view.h"
#include "app/terminal/log.h"
#include "bvh/wide/wide_bvh.h"
#include "io/drawings/density_picture.h"
#include "io/drawings/hemisphere_svg.h"
#include "io/files/atomic_file.h"
#include "radiosity/hemisphere/density.h"
#include "radiosity/sampling/rng.h"
#include "radiosity/sampling/workers.h"
#include "radiosity/shooting/strategy.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hemilux {

namespace {

/// All that the drawings are made from.
struct Preprocessed {
    const DensitySettings& settings;
    const Mesh& mesh;
    const Tracer& tracer;
    const Hemisphere& hemisphere;
    const DensityMap& map;
    Monitor& monitor;
};

/// Of each patch's densities, weighted by the power of their triangles: D_average of the paper, and
/// the standard deviation.
struct PatchDensities {
    std::vector<double> mean, spread;
};

PatchDensities summarise(const Preprocessed& made) {
    PatchDensities result;
    std::vector<DensityLeaf> leaves;
    for (std::uint32_t i = 0; i < made.mesh.patches().size(); ++i) {
        made.map.leaves(i, leaves);
        double mean = 0, square = 0;
        for (const DensityLeaf& leaf : leaves) {
            const double share =
                made.hemisphere.cells()[leaf.cell].projected_solid_angle / std::numbers::pi;
            const double d = leaf.density;
            mean += share * d;
            square += share * d * d;
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

/// Directions of energy rays as the paper's method allocates them, in the hemisphere's frame.
std::vector<Vec3> energy_rays(const Preprocessed& made, std::uint32_t patch) {
    const SolveOptions& options = made.settings.options;
    const SolverInput input{made.mesh, made.tracer, options, made.monitor};
    const auto strategy =
        method_of(Role::paper).strategy(input, made.hemisphere, Workers(options.threads));
    AllocatedCells memory;
    const Allocation allocation = strategy->allocate(patch, memory);
    Rng rng(hash_words({options.seed, patch}));
    std::vector<Vec3> rays;
    double due = rng.uniform(); // whole numbers of rays by systematic rounding
    for (std::size_t k = 0; k < allocation.cells.size(); ++k) {
        due += allocation.rays(k) * made.settings.rays;
        for (; due >= 1; due -= 1)
            rays.push_back(made.hemisphere.cells()[allocation.cells[k]].shape.sample_rejection(
                [&] { return rng.uniform(); }));
    }
    return rays;
}

std::string title_of(const Preprocessed& made, std::uint32_t patch, double mean,
                     std::size_t triangles) {
    const Scene& scene = made.mesh.scene();
    const Facet& facet = scene.facets[made.mesh.patches()[patch].facet];
    return formatted("patch %u (", patch) + scene.materials[facet.material].name + ", " +
           scene.groups[facet.group] + "): " + counted(triangles, "triangle", "triangles") +
           formatted(", mean density %.3g", mean);
}

void write_hemisphere(const Preprocessed& made, const PatchDensities& densities,
                      std::uint32_t patch, const std::string& path) {
    std::vector<DensityLeaf> leaves;
    made.map.leaves(patch, leaves);
    std::vector<DensityCount> counts;
    made.map.counts(patch, counts);
    const std::vector<Vec3> rays =
        made.settings.rays > 0 ? energy_rays(made, patch) : std::vector<Vec3>{};
    write_atomically(path,
                     hemisphere_svg({made.hemisphere,
                                     title_of(made, patch, densities.mean[patch], leaves.size()),
                                     leaves, counts, rays}));
}

void write_picture(const Preprocessed& made, const PatchDensities& densities,
                   const std::string& path) {
    const ViewSettings& view = made.settings.view;
    std::vector<Vec3> light; // for the choice of a camera: everything is lit
    for (const double mean : densities.mean)
        light.emplace_back(1 + mean);
    const Camera camera = camera_of(view, made.mesh, made.tracer, light);
    const PictureTime time(made.monitor.interrupted);
    const RenderOptions options{.width = view.size.width,
                                .height = view.size.height,
                                .threads = made.settings.options.threads,
                                .give_up = [&time] { return time.is_over(); }};
    write_png(path,
              density_picture(made.mesh, made.tracer, densities.mean,
                              "mean density of patches, surfaces per ray", camera, options),
              1);
}

bool is_svg(const std::string& path) { return extension_of(path) == ".svg"; }

void check(const DensitySettings& settings) {
    const bool draws = std::ranges::any_of(settings.outputs, is_svg);
    if (!draws && (settings.patch || settings.rays > 0))
        throw UsageError("--patch and --rays are for .svg outputs, and there is none");
}

void check_patch(const DensitySettings& settings, const Mesh& mesh) {
    const std::size_t patches = mesh.patches().size();
    if (settings.patch && *settings.patch >= patches)
        throw UsageError(formatted("--patch: there is no patch %u; they are numbered from 0 to %zu",
                                   *settings.patch, patches - 1));
}

void log_summary(const Preprocessed& made, const PatchDensities& densities) {
    const auto [least, most] = std::ranges::minmax(densities.mean);
    log_line(made.settings.verbosity, Verbosity::normal,
             counted(densities.mean.size(), "patch", "patches") + ", " +
                 short_count(static_cast<double>(made.map.rays())) + " density rays, " +
                 byte_size(made.map.bytes()) +
                 formatted("; mean density of a patch %.3g to %.3g", least, most));
}

} // namespace

int density(const DensitySettings& settings) {
    const RunFiles files = check_files(settings.outputs, settings.scene.path);
    check(settings);
    Monitor monitor;
    InterruptGuard guard;
    const Mesh mesh = load_geometry(settings.scene, files, settings.verbosity);
    check_camera(settings.view, mesh);
    check_patch(settings, mesh);
    const WideBvh bvh(mesh.soup_to_trace(), {.threads = settings.options.threads});
    guard.watch(monitor.interrupted);
    const Hemisphere hemisphere(settings.options.depth);
    const DensityMap map(mesh, bvh, hemisphere, settings.options.threshold,
                         Workers(settings.options.threads), monitor);
    if (monitor.interrupted) {
        log_line(settings.verbosity, Verbosity::quiet, "interrupted; nothing was written");
        return exit_code_of_signal();
    }
    const Preprocessed made{settings, mesh, bvh, hemisphere, map, monitor};
    const PatchDensities densities = summarise(made);
    log_summary(made, densities);
    std::optional<std::uint32_t> patch;
    if (std::ranges::any_of(settings.outputs, is_svg))
        patch = patch_to_draw(made, densities);
    WriteReport report;
    for (const std::string& path : settings.outputs)
        report.attempt(path, [&] {
            if (is_svg(path))
                write_hemisphere(made, densities, *patch, path);
            else
                write_picture(made, densities, path);
        });
    report.log(settings.verbosity);
    return report.exit_code(monitor.interrupted);
}

} // namespace hemilux
