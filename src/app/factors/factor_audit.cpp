#include "app/factors/factor_audit.h"

#include "app/terminal/log.h"
#include "app/terminal/summary.h"
#include "radiosity/answers/asked/text.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace hemilux {
namespace {

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
            for (std::size_t k = 0; k < (settings.ground ? 2 : 1); ++k)
                if (open[k].factor > 0)
                    reached =
                        std::max(reached, open[k].standard_error / std::max(open[k].factor, least));
        text = (settings.ground ? "sky and ground: " : "sky: ") + percent(reached) +
               " of each at most, or of 0.01 where it is smaller";
        break;
    }
    case FactorAim::Of::pair: {
        const OpenShare factor = factors.between(surfaces.row_named(settings.aim.from),
                                                 surfaces.row_named(settings.aim.to));
        reached = factor.factor > 0 ? factor.standard_error / factor.factor : 0;
        text = "F from '" + settings.aim.from + "' to '" + settings.aim.to + "' " +
               formatted("%.8g +- %.2g", factor.factor, factor.standard_error);
        break;
    }
    }
    log_line(settings.verbosity, Verbosity::normal, "standard errors: " + text);
    if (reached <= settings.error)
        return;
    const bool is_cut_short = factors.work.rows_left > 0;
    log_line(settings.verbosity, Verbosity::normal,
             "warning: the error is " + percent(reached) + ", where " + percent(settings.error) +
                 " was asked for; " +
                 (is_cut_short ? "the run was ended before"
                               : "most of it is where little is seen past many edges") +
                 (settings.aim.of == FactorAim::Of::sky || is_cut_short
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

} // namespace

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

void log_audit(const ViewFactorSettings& settings, const FactorSurfaces& surfaces,
               const ViewFactors& factors, double seconds) {
    const auto line = [&](const std::string& text) {
        log_line(settings.verbosity, Verbosity::normal, text);
    };
    const ExchangeWork& work = factors.work;
    if (work.rows_left > 0)
        line("the run was ended: " + counted(work.rows_left, "patch has", "patches have") +
             " fewer rays than the error asks for");
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
    if (audit.unsolved > 0)
        line(formatted("warning: the iterations ended before the rows were closed: sums are off by "
                       "%.2g at most, which the errors hold",
                       audit.unsolved));
    constexpr double far_beyond_chance = 1.5;
    if (audit.chance_rms > far_beyond_chance && audit.lacking_rms > 1e-8)
        line("warning: the rows lacked more than chance explains; an opening that no ray found, or "
             "faces that lie through each other, may be the cause: patch " +
             std::to_string(audit.worst_row) + formatted(" lacked %.2g", audit.lacking_worst));
    log_turned(settings, surfaces, factors);
}

void log_points(const ViewFactorSettings& settings, std::span<const PointFactors> points,
                double seconds) {
    std::size_t known = 0, exact = 0, factors = 0;
    double worst = 0, unlisted = 0;
    for (const PointFactors& point : points) {
        known += point.is_known ? 1 : 0;
        unlisted = std::max(unlisted, point.unlisted_bound);
        for (const double error : point.standard_error) {
            ++factors;
            exact += error == 0 ? 1 : 0;
            worst = std::max(worst, error);
        }
    }
    if (points.empty())
        return;
    const std::string left = known < points.size()
                                 ? "; " + grouped(points.size() - known) + " were not reached"
                                 : std::string();
    log_line(
        settings.verbosity, Verbosity::normal,
        counted(known, "point", "points") + ": " + grouped(exact) + " of " +
            counted(factors, "factor", "factors") + " exact, the largest standard error " +
            formatted("%.2g; not listed are at most %.2g of a row (95 %%), ", worst, unlisted) +
            duration(seconds) + left);
}

void log_sunlit(const ViewFactorSettings& settings, const SunlitRun& run, std::size_t suns,
                double seconds) {
    log_line(settings.verbosity, Verbosity::normal,
             counted(run.suns, "sun", "suns") + ": " + grouped(run.exact) + " of " +
                 counted(run.all, "sunlit fraction", "sunlit fractions") +
                 " exact, the largest standard error " + formatted("%.2g, ", run.worst_error) +
                 duration(seconds) +
                 (run.suns < suns ? "; " + grouped(suns - run.suns) + " were not reached" : ""));
}

} // namespace hemilux
