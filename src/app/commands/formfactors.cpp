// hemilux formfactors: the matrix that the method `matrix` solves with.

#include "app/commands/commands.h"
#include "app/loading/load_geometry.h"
#include "app/running/signals.h"
#include "app/running/write_report.h"
#include "app/settings/exit_code.h"
#include "app/settings/extension.h"
#include "app/settings/method_options.h"
#include "app/terminal/log.h"
#include "app/terminal/stage.h"
#include "app/terminal/unused_options.h"
#include "bvh/wide/wide_bvh.h"
#include "io/results/factor_files.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/answers/run/run_findings.h"
#include "radiosity/engine/factors/points/hemicube.h"
#include "radiosity/engine/form_factors/closed_form_factors.h"
#include "radiosity/engine/form_factors/factor_options.h"
#include "radiosity/engine/form_factors/matrix_quality.h"
#include "radiosity/engine/form_factors/sampled_form_factors.h"
#include "radiosity/engine/solving/own_options.h"

#include <algorithm>

namespace hemilux {

namespace {

bool is_dense(const std::string& path) { return extension_of(path) == ".npy"; }

void check_size(const FormFactorSettings& settings, std::size_t patches) {
    if (patches > settings.max_dense && std::ranges::any_of(settings.outputs, is_dense))
        throw UsageError("a dense .npy matrix is for up to " + grouped(settings.max_dense) +
                         " patches, not " + grouped(patches) + "; write .csv instead");
}

void log_quality(Verbosity verbosity, const MatrixQuality& quality) {
    const auto line = [verbosity](const std::string& text) {
        log_line(verbosity, Verbosity::normal, text);
    };
    line(counted(quality.entries, "factor", "factors") +
         formatted(" above 0, from %.3g to %.6g", quality.least, quality.most));
    line(formatted("rows: |sum - 1 + lost| %.2g on average, %.2g at most", quality.closure_mean,
                   quality.closure_most) +
         "; lost " + percent(quality.lost_mean) + " on average");
    line(formatted("reciprocity: |A_i F_ij - A_j F_ji| is %.2g of the whole; as a factor %.2g at "
                   "most",
                   quality.reciprocity_mean, quality.reciprocity_most));
}

/// Returns the bytes of the factors between so many patches at their peak: the hits of rays, both
/// ways of each pair, the matrix, and for exact factors the list of all pairs.
double bytes_of_factors(const FormFactorSettings& settings, double patches) {
    constexpr double per_hit = 64, per_pair = 80, per_pixel = 128, per_patch = 100;
    const FactorOptions& factors = own_options<FactorOptions>(settings.options);
    const double edge = factors.hemicube_edge, pixels = 3 * edge * edge;
    const bool by_cubes = factors.kind == FactorKind::hemicube;
    const double of_row = std::min(patches, by_cubes ? pixels : double(settings.rays));
    double bytes = per_patch * patches + per_hit * patches * of_row;
    if (factors.kind == FactorKind::exact)
        bytes += per_pair * patches * patches;
    if (by_cubes)
        bytes += Workers(settings.options.threads).threads() * per_pixel * pixels;
    return bytes;
}

struct Factors {
    SparseMatrix matrix;
    MatrixQuality quality;
};

void log_rays(Verbosity verbosity, std::size_t patches, std::uint64_t rays) {
    log_line(verbosity, Verbosity::normal,
             counted(patches, "patch", "patches") + ", " + short_counted(rays, "ray", "rays"));
}

/// Finds the factors by hemicubes; nothing where the user interrupted.
std::optional<Factors> by_hemicubes(const FormFactorSettings& settings, const Mesh& mesh,
                                    const Tracer& tracer, const Workers& workers,
                                    Monitor& monitor) {
    const Hemicube cube(own_options<FactorOptions>(settings.options).hemicube_edge);
    HemicubeFormFactors factors = hemicube_form_factors(cube, mesh, tracer, workers, monitor);
    if (monitor.interrupted)
        return std::nullopt;
    log_rays(settings.verbosity, mesh.patches().size(), factors.rays);
    log_line(settings.verbosity, Verbosity::normal, hemicube_finding().with_advice());
    const MatrixQuality quality = assess_matrix(factors.matrix, mesh, factors.lost);
    return Factors{std::move(factors.matrix), quality};
}

/// Finds the factors by integrals; nothing where the user interrupted.
std::optional<Factors> by_integrals(const FormFactorSettings& settings, const Mesh& mesh,
                                    const Tracer& tracer, const Workers& workers,
                                    Monitor& monitor) {
    const ClosedFormFactors exact(mesh, tracer, workers, monitor);
    const std::uint32_t rays = std::max(settings.rays, ClosedFormFactors::min_rays);
    std::optional<ClosedFactors> factors =
        monitor.interrupted
            ? std::nullopt
            : exact.batch(settings.options.seed, rays, relative_above(.01, 1e-3), workers, monitor);
    if (!factors)
        return std::nullopt;
    log_rays(settings.verbosity, mesh.patches().size(), factors->rays);
    log_line(settings.verbosity, Verbosity::normal,
             counted(exact.clear_pairs(), "pair", "pairs") + " by contour integration, " +
                 grouped(exact.other_pairs()) + " by rays");
    const MatrixQuality quality = assess_matrix(factors->matrix, mesh, factors->lost);
    return Factors{std::move(factors->matrix), quality};
}

/// Finds the factors by rays; nothing where the user interrupted.
std::optional<Factors> by_rays(const FormFactorSettings& settings, const Mesh& mesh,
                               const Tracer& tracer, const Workers& workers, Monitor& monitor) {
    SampledFormFactors samples(mesh, tracer, {}, settings.options.seed);
    const std::uint64_t traced = samples.trace_up_to(settings.rays, workers, monitor);
    if (monitor.interrupted)
        return std::nullopt;
    log_rays(settings.verbosity, mesh.patches().size(), traced);
    SparseMatrix matrix = samples.matrix();
    const MatrixQuality quality = assess_matrix(matrix, mesh, samples.lost());
    return Factors{std::move(matrix), quality};
}

} // namespace

int formfactors(const FormFactorSettings& settings) {
    const RunFiles files = check_files(settings.outputs, settings.scene.path);
    const FactorKind kind = own_options<FactorOptions>(settings.options).kind;
    const bool by_cubes = kind == FactorKind::hemicube, is_exact = kind == FactorKind::exact;
    const OptionUse rays{"--rays", !by_cubes, "factors by rays"};
    warn_of_unused(settings.given, {&rays, 1}, settings.verbosity);
    Monitor monitor;
    InterruptGuard guard;
    const GeometryUse use{[&](double patches) { return bytes_of_factors(settings, patches); },
                          "a larger --max-edge and fewer --rays need less"};
    const Mesh mesh =
        load_geometry(settings.scene, files, settings.options, use, settings.verbosity).mesh;
    check_size(settings, mesh.patches().size());
    const WideBvh bvh(mesh.soup_to_trace(), {.threads = settings.options.threads});
    guard.watch(monitor.interrupted.own().wished);
    const Workers workers(settings.options.threads);
    std::optional<Stage> stage(std::in_place, "finding factors", settings.verbosity);
    const auto find = by_cubes ? by_hemicubes : is_exact ? by_integrals : by_rays;
    const auto factors = find(settings, mesh, bvh, workers, monitor);
    if (!factors) {
        log_line(settings.verbosity, Verbosity::quiet, "interrupted; nothing was written");
        return exit_code_of_signal();
    }
    log_quality(settings.verbosity, factors->quality);
    stage.reset();
    stage.emplace("writing", settings.verbosity);
    WriteReport report;
    for (const std::string& path : settings.outputs)
        report.attempt(path, [&] {
            if (is_dense(path))
                write_npy(path, factors->matrix, &monitor.interrupted.own().wished);
            else
                write_factor_table(path, factors->matrix, &monitor.interrupted.own().wished);
        });
    const bool interrupted(monitor.interrupted);
    report.log(settings.verbosity);
    report.log_interruption(settings.verbosity, interrupted);
    return report.exit_code(interrupted);
}

} // namespace hemilux
