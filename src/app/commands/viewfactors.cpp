// hemilux viewfactors: factors between surfaces, each with its standard error, closed.

#include "app/commands/commands.h"
#include "app/factors/factor_audit.h"
#include "app/factors/factor_checkpoint.h"
#include "app/factors/heat_table.h"
#include "app/factors/sunlit_run.h"
#include "app/gathering/point_table.h"
#include "app/loading/load.h"
#include "app/memory/memory.h"
#include "app/running/signals.h"
#include "app/running/write_report.h"
#include "app/settings/exit_code.h"
#include "app/settings/factor_aim.h"
#include "app/terminal/log.h"
#include "app/terminal/stage.h"
#include "app/terminal/summary.h"
#include "bvh/wide/wide_bvh.h"
#include "io/files/error.h"
#include "io/meshes/factor_cells.h"
#include "io/results/view_factor_files.h"
#include "io/results/view_factor_legend.h"
#include "parallel/stopwatch.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/answers/surfaces/surface_factors.h"
#include "radiosity/answers/surfaces/surface_points.h"

#include <algorithm>
#include <optional>

namespace hemilux {

namespace {

constexpr const char* advice_for_memory = "a larger --max-edge and fewer --rays need less";

struct LoadedSurfaces {
    Mesh mesh;
    int up;
    MemoryNeed need; ///< but for the pairs, whose number the rays find
};

/// Returns the need but for the pairs: planes and names of surfaces, and what threads look at.
MemoryNeed need_of(const Scene& scene, const ViewFactorSettings& settings) {
    constexpr double per_patch = 1500, of_thread = 16e6, per_band = 2 * sizeof(OpenShare);
    const double patches = patches_of(scene, settings.scene.mesh);
    MemoryNeed need = memory_need(scene, settings.scene.mesh, settings.options, {});
    need.method = Workers(settings.options.threads).threads() * of_thread;
    const std::optional<SkyBands> bands = bands_of(settings.sky_bands, 0);
    need.results =
        (per_patch + (bands ? per_band * static_cast<double>(bands->size()) : 0)) * patches;
    return need;
}

LoadedSurfaces load_surfaces(const ViewFactorSettings& settings, const RunFiles& files) {
    const Stage stage("reading", settings.verbosity);
    check_memory_to_read(settings.scene.path, settings.scene.memory);
    ReadResult read = load_scene(settings.scene, files);
    log_warnings(settings.verbosity, read.warnings);
    if (read.scene.facets.empty())
        throw InputError(settings.scene.path, "there is no face with an area");
    if (settings.scene.sides == Sides::front)
        for (Facet& facet : read.scene.facets)
            facet.two_sided = false;
    const MemoryNeed need = need_of(read.scene, settings);
    check_memory(need, settings.scene.memory, settings.scene.path, advice_for_memory);
    const FileView view = view_of_file(settings.scene.path, read);
    Mesh mesh = divide_scene(std::move(read.scene), settings.scene, settings.options.threads);
    log_line(settings.verbosity, Verbosity::verbose, mesh_text(mesh));
    return {std::move(mesh), settings.up.value_or(view.usual_up.value_or(2)), need};
}

/// Reads the file of --points, if there is one.
std::vector<NamedPoint> points_of(const ViewFactorSettings& settings, const RunFiles& files) {
    if (settings.points.empty())
        return {};
    files.read("file of --points", settings.points);
    if (is_same_stream(settings.points, settings.scene.path))
        throw UsageError("--points: '" + settings.points + "' is a pipe, which can be read once");
    return read_points(settings.points);
}

void check_dense(const ViewFactorSettings& settings, std::size_t rows, std::size_t points,
                 const std::optional<SkyBands>& bands) {
    const std::size_t sky = bands ? bands->size() : settings.sky ? 1 : 0;
    const auto n = static_cast<double>(rows + sky + (settings.ground ? 1 : 0));
    const double bytes = n * (n + static_cast<double>(points)) * sizeof(double);
    for (const std::string& path : settings.outputs)
        if (factor_file_of(path) == FactorFile::dense &&
            bytes > ViewFactorSettings::max_dense_bytes)
            throw UsageError(path + ": a dense matrix of " + grouped(rows) +
                             " surfaces would take " +
                             byte_size(static_cast<std::uint64_t>(bytes)) +
                             "; write .npz instead, which scipy.sparse.load_npz reads");
}

/// Returns the points as rows: `point 0` and so on, as the file has them.
std::vector<FactorPlace> places_of(std::span<const NamedPoint> points) {
    std::vector<FactorPlace> places;
    for (const NamedPoint& point : points)
        places.push_back(
            {"point " + std::to_string(places.size()), point.position, point.given_normal});
    return places;
}

/// Throws UsageError where --of sky is to write factors that it does not compute.
void check_sky(const ViewFactorSettings& settings) {
    if (settings.aim.of != FactorAim::Of::sky)
        return;
    if (!settings.heat.output.empty())
        throw UsageError("--of sky computes no factors between surfaces, by which they exchange "
                         "heat");
    for (const std::string& path : settings.outputs) {
        const auto kind = factor_file_of(path);
        if (kind != FactorFile::udales_sky && kind != FactorFile::cells)
            throw UsageError(path +
                             ": --of sky computes no factors between surfaces; -o svf.inp... "
                             "or .vtu and --legend have sky and ground");
    }
}

void write(const std::string& path, const ViewFactorSettings& settings, const Mesh& mesh,
           const FactorSurfaces& surfaces, const FactorTable& table,
           std::span<const std::vector<OpenShare>> sunlit) {
    switch (factor_file_of(path).value()) {
    case FactorFile::pairs:
        return write_factor_pairs(path, table);
    case FactorFile::sparse:
        return write_factor_npz(path, table, settings.from);
    case FactorFile::dense:
        return write_dense_factors(path, table);
    case FactorFile::cells:
        return write_factor_vtu(path, mesh, surfaces.row_of, table, sunlit);
    case FactorFile::udales_factors:
        return write_udales_factors(path, table);
    case FactorFile::udales_sky:
        return write_udales_sky(path, table);
    }
}

/// What a run computes; what it is computed of outlives it.
struct FoundFactors {
    bool has_factors = false;
    ViewFactors factors;
    std::vector<FactorPlace> places;
    std::vector<FactorPoint> points;
    std::vector<PointFactors> point_rows;
    std::vector<GreySurface> grey; ///< of `exchange`, by row
};

/// Returns whether anything but --sunlit is to be written.
bool wants_factors(const ViewFactorSettings& settings) {
    return !settings.outputs.empty() || !settings.legend.empty() || !settings.heat.output.empty();
}

/// Computes what is to be written, and logs how exact it is.
FoundFactors compute(const ViewFactorSettings& settings, const FactorScene& scene,
                     std::span<const NamedPoint> points, Monitor& monitor) {
    const Stage stage(monitor, settings.verbosity);
    const Stopwatch watch;
    FoundFactors results;
    if (!settings.heat.surfaces.empty()) {
        results.grey = read_grey_surfaces(settings.heat.surfaces, scene.surfaces);
        check_temperatures(settings, scene, results.grey);
    }
    results.places = places_of(points);
    results.points = factor_points(results.places, scene.mesh, scene.tree);
    if (!wants_factors(settings))
        return results;
    results.factors = compute_factors(settings.asked(), scene, monitor);
    results.has_factors = results.factors.rows() > 0;
    if (!results.has_factors)
        return results;
    log_audit(settings, scene.surfaces, results.factors, watch.seconds());
    const Stopwatch at_points;
    results.point_rows = compute_points(settings.asked(), scene, results.points, monitor);
    log_points(settings, results.point_rows, at_points.seconds());
    return results;
}

FactorTable table_of(const ViewFactorSettings& settings, const FactorScene& scene,
                     const FoundFactors& results, const Monitor& monitor) {
    FactorTable table{results.factors,
                      scene.surfaces.rows,
                      {},
                      monitor.interrupted ? nullptr : &monitor.interrupted.own().wished,
                      settings.aim.of != FactorAim::Of::sky,
                      results.point_rows,
                      results.places,
                      scene.bands};
    if (settings.sky)
        table.columns.push_back(Open::sky);
    if (settings.ground)
        table.columns.push_back(Open::ground);
    return table;
}

/// Returns the directions to the suns, that of --sun first.
std::vector<Vec3> suns_of(const ViewFactorSettings& settings, const RunFiles& files) {
    std::vector<Vec3> suns;
    if (settings.sun)
        suns.push_back(*settings.sun);
    if (!settings.suns.empty()) {
        files.read("file of --suns", settings.suns);
        const std::vector<Vec3> more = read_directions(settings.suns);
        suns.insert(suns.end(), more.begin(), more.end());
    }
    if (suns.empty() != settings.sunlit.empty())
        throw UsageError(suns.empty() ? "--sunlit: name the sun by --sun or --suns"
                                      : "--sun and --suns are for --sunlit FILE.csv");
    for (Vec3& sun : suns)
        sun = -sun;
    return suns;
}

void warn_of_low_suns(const ViewFactorSettings& settings, std::span<const Vec3> suns, int up) {
    const auto low = std::ranges::count_if(suns, [up](const Vec3& sun) { return sun[up] < 0; });
    if (low > 0)
        log_line(
            settings.verbosity, Verbosity::normal,
            "warning: " + counted(static_cast<std::uint64_t>(low), "sun shines", "suns shine") +
                " from below the horizon; --sun and --suns say where their light goes");
}

/// Returns the files of the run. Throws UsageError where there is nothing to write.
RunFiles files_of(const ViewFactorSettings& settings) {
    std::vector<std::string> outputs = settings.outputs;
    for (const std::string& path : {settings.legend, settings.sunlit, settings.heat.output})
        if (!path.empty())
            outputs.push_back(path);
    if (outputs.empty() || outputs == std::vector{settings.legend})
        throw UsageError("--output: name a file to write, or one of --sunlit");
    RunFiles files = check_files(outputs, settings.scene.path);
    if (!settings.heat.surfaces.empty())
        files.read("file of --surfaces", settings.heat.surfaces);
    check_checkpoint_files(settings, files);
    return files;
}

/// Writes all files, and finds the sunlit fractions as they are written. Files that have these,
/// too, come last.
WriteReport write_found(const ViewFactorSettings& settings, const FactorScene& scene,
                        const FoundFactors& results, std::span<const Vec3> suns, Monitor& monitor) {
    WriteReport report;
    SunlitRun sunlit;
    const auto has_sunlit = [&](const std::string& path) {
        return !suns.empty() && factor_file_of(path) == FactorFile::cells;
    };
    const auto write_outputs = [&](bool with_sunlit) {
        if (!results.has_factors)
            return;
        const Stage stage("writing", settings.verbosity);
        const FactorTable table = table_of(settings, scene, results, monitor);
        for (const std::string& path : settings.outputs)
            if (has_sunlit(path) == with_sunlit)
                report.attempt(path, [&] {
                    write(path, settings, scene.mesh, scene.surfaces, table, sunlit.kept);
                });
        if (!settings.legend.empty() && !with_sunlit)
            report.attempt(settings.legend, [&] { write_factor_legend(settings.legend, table); });
    };
    write_outputs(false);
    if (results.has_factors && !settings.heat.output.empty()) {
        const Stage stage("exchanging heat", settings.verbosity);
        report.attempt(settings.heat.output, [&] {
            write_heat(settings, scene.surfaces, results.grey, results.factors,
                       scene.mesh.frame().area_to_world(1));
        });
    }
    if (suns.empty())
        return report;
    report.attempt(settings.sunlit, [&] {
        if (monitor.interrupted)
            throw Interrupted();
        const Stage stage(monitor, settings.verbosity);
        const Stopwatch watch;
        sunlit = write_sunlit(settings.sunlit, settings, scene, suns, results.points,
                              table_of(settings, scene, results, monitor).size(),
                              std::ranges::any_of(settings.outputs, has_sunlit), monitor);
        log_sunlit(settings, sunlit, suns.size(), watch.seconds());
    });
    write_outputs(true);
    return report;
}

} // namespace

int viewfactors(const ViewFactorSettings& settings) {
    check_checkpoint_options(settings);
    const RunFiles files = files_of(settings);
    FactorCheckpoint checkpoint(settings);
    const std::vector<NamedPoint> points = points_of(settings, files);
    const std::vector<Vec3> suns = suns_of(settings, files);
    Monitor monitor;
    InterruptGuard guard;
    const LoadedSurfaces loaded = load_surfaces(settings, files);
    warn_of_low_suns(settings, suns, loaded.up);
    const FactorSurfaces surfaces = factor_surfaces(loaded.mesh, settings.by);
    const std::optional<SkyBands> bands = bands_of(settings.sky_bands, loaded.up);
    check_distances(settings.points, points, loaded.mesh);
    check_dense(settings, surfaces.rows.size(), points.size(), bands);
    check_sky(settings);
    check_aim(settings.aim, surfaces);
    const WideBvh tree(loaded.mesh.soup_to_trace(), {.threads = settings.options.threads});
    guard.watch(monitor.interrupted.own().wished);
    FactorScene scene{
        loaded.mesh,
        tree,
        surfaces,
        loaded.up,
        memory_guard(loaded.need, settings.scene.memory, settings.scene.path, advice_for_memory),
        bands ? &*bands : nullptr};
    checkpoint.attach(scene);
    const FoundFactors results = compute(settings, scene, points, monitor);
    WriteReport report = write_found(settings, scene, results, suns, monitor);
    report.add(checkpoint.report());
    if (!results.has_factors && wants_factors(settings) && report.failed.empty()) {
        log_line(settings.verbosity, Verbosity::quiet, "interrupted; nothing was written");
        return exit_code_of_signal();
    }
    report.log(settings.verbosity);
    report.log_interruption(settings.verbosity, bool(monitor.interrupted));
    return report.exit_code(bool(monitor.interrupted));
}

} // namespace hemilux
