// hemilux viewfactors: factors between surfaces, each with its standard error, closed.

#include "app/commands/commands.h"
#include "app/commands/factor_surfaces.h"
#include "app/loading/load.h"
#include "app/running/signals.h"
#include "app/running/write_report.h"
#include "app/settings/exit_code.h"
#include "app/settings/factor_aim.h"
#include "app/settings/text.h"
#include "app/terminal/log.h"
#include "app/terminal/stopwatch.h"
#include "app/terminal/summary.h"
#include "bvh/wide/wide_bvh.h"
#include "io/meshes/factor_cells.h"
#include "io/results/view_factor_files.h"

#include <algorithm>
#include <cmath>

namespace hemilux {

namespace {

/// A factor's own error may be so much larger than the root mean square that is asked for, as exact
/// factors have none.
constexpr double slack_of_rms = 1.5;

struct LoadedSurfaces {
    Mesh mesh;
    int up;
};

LoadedSurfaces load_surfaces(const ViewFactorSettings& settings, const RunFiles& files) {
    ReadResult read = load_scene(settings.scene, files);
    log_warnings(settings.verbosity, read.warnings);
    if (read.scene.facets.empty())
        throw InputError(settings.scene.path, "there is no face with an area");
    if (settings.scene.sides == Sides::front)
        for (Facet& facet : read.scene.facets)
            facet.two_sided = false;
    const FileView view = view_of_file(settings.scene.path, read);
    Mesh mesh = divide_scene(std::move(read.scene), settings.scene, settings.options.threads);
    log_line(settings.verbosity, Verbosity::verbose, mesh_text(mesh));
    return {std::move(mesh), settings.up.value_or(view.up.value_or(2))};
}

/// Throws UsageError for a name that no surface has.
std::uint32_t row_named(const FactorSurfaces& surfaces, const std::string& name) {
    const std::optional<std::uint32_t> row = surfaces.named(name);
    if (!row)
        throw UsageError("--of pair: no surface is called '" + name +
                         "'; --by group or --by material has other names, and faces are numbers "
                         "from 0");
    return *row;
}

void check_dense(const ViewFactorSettings& settings, std::size_t rows) {
    const auto n = static_cast<double>(rows + (settings.sky ? 1 : 0) + (settings.ground ? 1 : 0));
    const double bytes = n * n * sizeof(double);
    for (const std::string& path : settings.outputs)
        if (factor_file_of(path) == FactorFile::dense &&
            bytes > ViewFactorSettings::max_dense_bytes)
            throw UsageError(path + ": a dense matrix of " + grouped(rows) +
                             " surfaces would take " +
                             byte_size(static_cast<std::uint64_t>(bytes)) +
                             "; write .npz instead, which scipy.sparse.load_npz reads");
}

/// Returns the tolerances that the aim asks for. `largest` is the smallest of the largest factors
/// of all rows, as far as it is known.
FactorTolerance tolerance_of(const ViewFactorSettings& settings, const FactorSurfaces& surfaces,
                             double largest) {
    const double error = settings.error;
    switch (settings.aim.of) {
    case FactorAim::Of::above:
        return relative_above(slack_of_rms * error, settings.aim.least);
    case FactorAim::Of::largest:
        return relative_above(error, largest);
    case FactorAim::Of::rows:
        // Squares of the errors of a row add up to at most error^2 times the sum of its factors.
        return [error](std::uint32_t, std::uint32_t, double factor) {
            constexpr double least = 1e-3;
            return error * std::max(std::sqrt(factor), least);
        };
    case FactorAim::Of::pair:
    case FactorAim::Of::sky: // which needs no pairs
        break;
    }
    const std::uint32_t a = row_named(surfaces, settings.aim.from),
                        b = row_named(surfaces, settings.aim.to);
    return [error, a, b, &surfaces](std::uint32_t i, std::uint32_t j, double factor) {
        constexpr double least_of_pair = 1e-4, least_of_others = .1;
        const std::uint32_t row = surfaces.row_of[i], column = surfaces.row_of[j];
        const bool counts = (row == a && column == b) || (row == b && column == a);
        return error * std::max(factor, counts ? least_of_pair : least_of_others);
    };
}

/// Throws UsageError where --of sky is to write factors that it does not compute.
void check_sky(const ViewFactorSettings& settings) {
    if (settings.aim.of != FactorAim::Of::sky)
        return;
    for (const std::string& path : settings.outputs) {
        const auto kind = factor_file_of(path);
        if (kind != FactorFile::udales_sky && kind != FactorFile::cells)
            throw UsageError(path +
                             ": --of sky computes no factors between surfaces; -o svf.inp... "
                             "or .vtu and --legend have sky and ground");
    }
}

/// The largest factor of each row: the smallest of all, and the worst relative error.
struct LargestFactors {
    double smallest = 1, worst_error = 0;
};

LargestFactors largest_factors(const ViewFactors& factors) {
    LargestFactors result;
    for (std::size_t i = 0; i < factors.rows(); ++i) {
        double largest = 0, error = 0;
        for (std::size_t k = factors.row_begin[i]; k < factors.row_begin[i + 1]; ++k)
            if (factors.factor[k] > largest) {
                largest = factors.factor[k];
                error = factors.standard_error[k];
            }
        if (!(largest > 0))
            continue;
        result.smallest = std::min(result.smallest, largest);
        result.worst_error = std::max(result.worst_error, error / largest);
    }
    return result;
}

double worst_row_error(const ViewFactors& factors) {
    double worst = 0;
    for (std::size_t i = 0; i < factors.rows(); ++i) {
        double squares = 0;
        for (std::size_t k = factors.row_begin[i]; k < factors.row_begin[i + 1]; ++k)
            squares += factors.standard_error[k] * factors.standard_error[k];
        worst = std::max(worst, squares);
    }
    return std::sqrt(worst);
}

/// Computes the factors; with `largest`, again where the largest factor of a row is smaller than
/// was thought.
ViewFactors compute(const ViewFactorSettings& settings, const LoadedSurfaces& loaded,
                    const FactorSurfaces& surfaces, const WideBvh& tree, Monitor& monitor) {
    const Workers workers(settings.options.threads);
    constexpr double first_guess = .01, smallest = 1e-4;
    const auto with_largest = [&](double largest) {
        const ExchangeOptions options{.rays = settings.rays,
                                      .tolerance = tolerance_of(settings, surfaces, largest),
                                      .seed = settings.options.seed,
                                      .up = loaded.up};
        return view_factors(loaded.mesh, tree, surfaces.row_of, surfaces.rows.size(), options,
                            workers, monitor);
    };
    if (settings.aim.of == FactorAim::Of::sky) {
        const OpenViews views = find_open_views(loaded.mesh, tree, settings.error,
                                                settings.options.seed, loaded.up, workers, monitor);
        ExchangeList list;
        for (const Patch& patch : loaded.mesh.patches())
            list.area.push_back(patch.area);
        list.pairs.resize(list.area.size());
        list.unlisted_bound.resize(list.area.size());
        list.open = views.open;
        ViewFactors factors = sum_over_rows(list, surfaces.row_of, surfaces.rows.size());
        factors.work.rays = views.rays;
        return factors;
    }
    ViewFactors factors = with_largest(first_guess);
    if (settings.aim.of != FactorAim::Of::largest || monitor.interrupted)
        return factors;
    const LargestFactors found = largest_factors(factors);
    return found.worst_error <= settings.error || found.smallest >= first_guess
               ? factors
               : with_largest(std::max(found.smallest, smallest));
}

/// Logs the error that was reached, and warns where it is larger than asked for.
void log_error(const ViewFactorSettings& settings, const FactorSurfaces& surfaces,
               const ViewFactors& factors) {
    double reached = 0;
    std::string text;
    switch (settings.aim.of) {
    case FactorAim::Of::above: {
        const FactorErrors errors = errors_above(factors, settings.aim.least);
        reached = errors.rms;
        text = formatted("factors of at least %g: ", settings.aim.least) + percent(errors.rms) +
               " rms, " + percent(errors.worst) + " at most, " +
               counted(errors.factors, "factor", "factors");
        break;
    }
    case FactorAim::Of::largest:
        reached = largest_factors(factors).worst_error;
        text = "largest factor of each row: " + percent(reached) + " at most";
        break;
    case FactorAim::Of::rows:
        reached = worst_row_error(factors);
        text = "all factors of a row together: " + percent(reached) + " of it at most";
        break;
    case FactorAim::Of::sky: {
        constexpr double least = .01;
        for (const auto& open : factors.open)
            for (std::size_t k = 0; k < 2; ++k)
                reached =
                    std::max(reached, open[k].standard_error / std::max(open[k].factor, least));
        text = "sky and ground: " + percent(reached) +
               " of each at most, or of 0.01 where it is smaller";
        break;
    }
    case FactorAim::Of::pair: {
        const OpenShare factor = factors.between(row_named(surfaces, settings.aim.from),
                                                 row_named(surfaces, settings.aim.to));
        reached = factor.factor > 0 ? factor.standard_error / factor.factor : 0;
        text = "F from '" + settings.aim.from + "' to '" + settings.aim.to + "' " +
               formatted("%.8g +- %.2g", factor.factor, factor.standard_error);
        break;
    }
    }
    log_line(settings.verbosity, Verbosity::normal, "standard errors: " + text);
    if (reached > settings.error)
        log_line(settings.verbosity, Verbosity::normal,
                 "warning: the error is " + percent(reached) + ", where " +
                     percent(settings.error) +
                     " was asked for; most of it is where little is seen past many edges" +
                     (settings.aim.of == FactorAim::Of::sky
                          ? ""
                          : ", and smaller faces (--max-edge) have a smaller one"));
}

/// Names a few rows whose views are lost on backs: most likely they are turned.
void log_turned(const ViewFactorSettings& settings, const FactorSurfaces& surfaces,
                const ViewFactors& factors) {
    constexpr double nearly_all = .999;
    constexpr std::size_t most = 4;
    std::size_t count = 0;
    std::string names;
    for (std::size_t i = 0; i < factors.rows(); ++i)
        if (factors.open[i][static_cast<std::size_t>(Open::back)].factor > nearly_all &&
            ++count <= most)
            names += (names.empty() ? "'" : ", '") + surfaces.rows[i].name + "'";
    if (count > 0)
        log_line(settings.verbosity, Verbosity::normal,
                 "warning: " + counted(count, "surface sees", "surfaces see") +
                     " nothing but backs of faces (" + names + (count > most ? ", ..." : "") +
                     "); such faces are probably turned, and --sides both gives each a back");
}

void log_audit(const ViewFactorSettings& settings, const FactorSurfaces& surfaces,
               const ViewFactors& factors, double seconds) {
    const auto line = [&](const std::string& text) {
        log_line(settings.verbosity, Verbosity::normal, text);
    };
    const ExchangeWork& work = factors.work;
    const std::string of_what = counted(factors.rows(), "surface", "surfaces") + " of " +
                                counted(surfaces.row_of.size(), "patch", "patches") + "; ";
    if (settings.aim.of == FactorAim::Of::sky) {
        line(of_what + short_counted(work.rays, "ray", "rays") + ", " + duration(seconds));
        log_error(settings, surfaces, factors);
        return log_turned(settings, surfaces, factors);
    }
    line(of_what + grouped(work.exact_pairs) + " pairs exact, " + grouped(work.line_pairs) +
         " by lines, " + grouped(work.ray_pairs) + " by rays; " +
         short_counted(work.rays, "ray", "rays") + ", " +
         short_counted(work.lines, "line", "lines") + ", " + duration(seconds));
    log_error(settings, surfaces, factors);
    if (work.clear_pairs > 0)
        line(counted(work.clear_pairs, "pair", "pairs") +
             " looked free along all lines without proof; the error covers it");
    const ClosingAudit& audit = factors.audit;
    double worst = 0, unlisted = 0;
    for (std::uint32_t i = 0; i < factors.rows(); ++i) {
        worst = std::max(worst, std::abs(factors.row_sum(i) - 1));
        unlisted = std::max(unlisted, factors.unlisted_bound[i]);
    }
    line(
        formatted("rows lacked %.2g rms of 1, %.2g times what the errors let expect; closed, their "
                  "sums are off by %.1g at most",
                  audit.lacking_rms, audit.chance_rms, worst));
    line(formatted("reciprocity: |A_i F_ij / (A_j F_ji) - 1| is %.1g at most; factors that are not "
                   "listed sum to less than %.2g of a row (95 %%)",
                   worst_reciprocity(factors), unlisted));
    constexpr double far_beyond_chance = 1.5;
    if (audit.chance_rms > far_beyond_chance && audit.lacking_rms > 1e-8)
        line("warning: the rows lacked more than chance explains; an opening that no ray found, or "
             "faces that lie through each other, may be the cause: patch " +
             std::to_string(audit.worst_row) + formatted(" lacked %.2g", audit.lacking_worst));
    log_turned(settings, surfaces, factors);
}

void write(const std::string& path, const ViewFactorSettings& settings, const Mesh& mesh,
           const FactorSurfaces& surfaces, const FactorTable& table) {
    switch (factor_file_of(path).value()) {
    case FactorFile::pairs:
        return write_factor_pairs(path, table);
    case FactorFile::sparse:
        return write_factor_npz(path, table, settings.from);
    case FactorFile::dense:
        return write_dense_factors(path, table);
    case FactorFile::cells:
        return write_factor_vtu(path, mesh, surfaces.row_of, table);
    case FactorFile::udales_factors:
        return write_udales_factors(path, table);
    case FactorFile::udales_sky:
        return write_udales_sky(path, table);
    }
}

} // namespace

int viewfactors(const ViewFactorSettings& settings) {
    std::vector<std::string> outputs = settings.outputs;
    if (!settings.legend.empty())
        outputs.push_back(settings.legend);
    const RunFiles files = check_files(outputs, settings.scene.path);
    Monitor monitor;
    InterruptGuard guard;
    const LoadedSurfaces loaded = load_surfaces(settings, files);
    const FactorSurfaces surfaces = factor_surfaces(loaded.mesh, settings.by);
    check_dense(settings, surfaces.rows.size());
    check_sky(settings);
    const Stopwatch computing;
    const WideBvh tree(loaded.mesh.soup_to_trace(), {.threads = settings.options.threads});
    guard.watch(monitor.interrupted.own().wished);
    const ViewFactors factors = compute(settings, loaded, surfaces, tree, monitor);
    if (monitor.interrupted) {
        log_line(settings.verbosity, Verbosity::quiet, "interrupted; nothing was written");
        return exit_code_of_signal();
    }
    log_audit(settings, surfaces, factors, computing.seconds());
    FactorTable table{factors,
                      surfaces.rows,
                      {},
                      &monitor.interrupted.own().wished,
                      settings.aim.of != FactorAim::Of::sky};
    if (settings.sky)
        table.columns.push_back(Open::sky);
    if (settings.ground)
        table.columns.push_back(Open::ground);
    WriteReport report;
    for (const std::string& path : settings.outputs)
        report.attempt(path, [&] { write(path, settings, loaded.mesh, surfaces, table); });
    if (!settings.legend.empty())
        report.attempt(settings.legend, [&] { write_factor_legend(settings.legend, table); });
    report.log(settings.verbosity);
    return report.exit_code(bool(monitor.interrupted));
}

} // namespace hemilux
