#include "radiosity/answers/surfaces/surface_factors.h"

#include "parallel/workers.h"
#include "radiosity/engine/factors/rows/open_views.h"
#include "radiosity/engine/solving/time_limit.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/solver.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace hemilux {
namespace {

/// A factor's own error may be so much larger than the root mean square that is asked for, as exact
/// factors have none.
constexpr double slack_of_rms = 1.5;

/// Returns the tolerances that the aim asks for. `largest` is the smallest of the largest factors
/// of all rows, as far as it is known.
FactorTolerance tolerance_of(const FactorsAsked& asked, const FactorSurfaces& surfaces,
                             double largest) {
    constexpr double least_of_row = 1e-3;
    const double error = asked.error;
    switch (asked.aim.of) {
    case FactorAim::Of::above:
        return relative_above(slack_of_rms * error, asked.aim.least);
    case FactorAim::Of::largest:
        return relative_above(error, largest);
    case FactorAim::Of::rows:
        // Squares of the errors of a row add up to at most error^2 times the sum of its factors.
        return {error * least_of_row, [=](std::uint32_t, std::uint32_t, double factor) {
                    return error * std::max(std::sqrt(factor), least_of_row);
                }};
    case FactorAim::Of::pair:
    case FactorAim::Of::sky: // which needs no pairs
        break;
    }
    const auto row_named = [&surfaces](const std::string& name) {
        const std::optional<std::uint32_t> row = surfaces.row_named(name);
        if (!row)
            throw std::invalid_argument("no surface is called '" + name + "'");
        return *row;
    };
    const std::uint32_t a = row_named(asked.aim.from), b = row_named(asked.aim.to);
    constexpr double least_of_pair = 1e-4, least_of_others = .1;
    const auto tolerance = [=, &surfaces](std::uint32_t i, std::uint32_t j, double factor) {
        const std::uint32_t row = surfaces.row_of[i], column = surfaces.row_of[j];
        const bool counts = (row == a && column == b) || (row == b && column == a);
        return error * std::max(factor, counts ? least_of_pair : least_of_others);
    };
    return {error * least_of_pair, tolerance};
}

/// With a limit of time, a coarse pass comes first: it takes a fraction of the time of the last,
/// and what the limit leaves of the last is as exact as it.
std::vector<double> passes_before(const FactorsAsked& asked) {
    return asked.seconds ? std::vector<double>{4} : std::vector<double>{};
}

} // namespace

std::optional<SkyBands> bands_of(const std::optional<SkyDivision>& division, int up) {
    if (!division)
        return {};
    return division->steps > 0 ? SkyBands::of_equal_steps(division->steps, up)
                               : SkyBands::tregenza(up);
}

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

ViewFactors compute_factors(const FactorsAsked& asked, const FactorScene& scene, Monitor& monitor) {
    const Workers workers(asked.threads);
    const TimeLimit limit(monitor.interrupted, asked.seconds);
    constexpr double first_guess = .01, smallest = 1e-4;
    const auto with_largest = [&](double largest) {
        const ExchangeOptions options{.rays = asked.rays,
                                      .tolerance = tolerance_of(asked, scene.surfaces, largest),
                                      .seed = asked.seed,
                                      .up = scene.up,
                                      .bands = scene.bands,
                                      .before = passes_before(asked),
                                      .ask = scene.ask,
                                      .load = scene.load,
                                      .keep = scene.keep};
        return view_factors(scene.mesh, scene.tree, scene.surfaces.row_of,
                            scene.surfaces.rows.size(), options, workers, monitor);
    };
    if (asked.aim.of == FactorAim::Of::sky) {
        const OpenViews views = find_open_views(scene.mesh, scene.tree,
                                                {.error = asked.error,
                                                 .ground = asked.ground,
                                                 .seed = asked.seed,
                                                 .up = scene.up,
                                                 .bands = scene.bands},
                                                workers, monitor);
        ExchangeList list;
        for (const Patch& patch : scene.mesh.patches())
            list.area.push_back(patch.area);
        list.pairs.resize(list.area.size());
        list.unlisted_bound.resize(list.area.size());
        list.open = views.open;
        list.bands = views.bands;
        if (views.is_void)
            return {};
        ViewFactors factors =
            sum_over_rows(std::move(list), scene.surfaces.row_of, scene.surfaces.rows.size());
        factors.work.rows_left = views.rows_left;
        factors.work.rays = views.rays;
        return factors;
    }
    ViewFactors factors = with_largest(first_guess);
    if (asked.aim.of != FactorAim::Of::largest || monitor.interrupted)
        return factors;
    const LargestFactors found = largest_factors(factors);
    if (found.worst_error <= asked.error || found.smallest >= first_guess)
        return factors;
    if (!asked.seconds)
        factors = {}; // before there are others
    ViewFactors better = with_largest(std::max(found.smallest, smallest));
    if (better.work.rows_left > 0 && factors.rows() > 0)
        return factors;
    return better;
}

std::vector<PointFactors> compute_points(const FactorsAsked& asked, const FactorScene& scene,
                                         std::span<const FactorPoint> points, Monitor& monitor) {
    const PointFactorOptions options{.error = asked.error,
                                     .least = asked.aim.least,
                                     .rays = asked.rays,
                                     .seed = asked.seed,
                                     .up = scene.up,
                                     .bands = scene.bands,
                                     .ask = scene.ask};
    return point_factors(points, scene.mesh, scene.tree, scene.surfaces.row_of, options,
                         Workers(asked.threads), monitor);
}

} // namespace hemilux
