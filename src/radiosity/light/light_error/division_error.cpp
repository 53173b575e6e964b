#include "radiosity/light/light_error/division_error.h"

#include "parallel/workers.h"
#include "radiosity/light/final_gather/light_within_patches.h"
#include "radiosity/light/final_gather/linear_light.h"
#include "radiosity/light/final_gather/surface_points.h"
#include "radiosity/light/light_error/error_at_points.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solution/error_spread.h"
#include "radiosity/paper/solution/missed_light.h"
#include "radiosity/paper/solution/solution.h"
#include "radiosity/paper/solving/stop_flag.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace hemilux {
namespace {

/// The error that has spread to others is found to this share of the error within patches.
constexpr double share_of_spread = .4;

/// The variance of the patches' values, relative to their square, in its two parts.
struct KnownVariance {
    double own = 0;     ///< of what patches err each for itself
    double common = 0;  ///< of what they err together
    double freedom = 1; ///< effective degrees of freedom

    /// Returns by how much the square of one error scatters [-]: it is not as large as errors are
    /// on average.
    [[nodiscard]] double scatter() const { return std::sqrt(2 / freedom); }
};

KnownVariance known_variance(const Mesh& mesh, const Solution& solution, double size) {
    double sum = 0;
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i) {
        const Vec3& sigma = solution.standard_error[i];
        sum += solution.weight_of(i) * mesh.patches()[i].area * glm::dot(sigma, sigma);
    }
    const double all = solution.variance.value_or(std::isfinite(sum) ? sum : 0) / size;
    const double freedom = std::max(1.0, error_spread(mesh, solution).freedom); // 1 if unknown
    return {all * (1 - 1 / freedom), all / freedom, freedom};
}

/// Reports an error that is hardly known as nearly as large as it may be.
DivisionError reported(const SquaredError& found) {
    constexpr double share = .8;
    // The square of the light itself is larger by that of the error.
    const auto relative = [](double square) { return std::sqrt(square / (1 + square)); };
    const double square = std::max(found.square, 0.0);
    const double error = relative(square), most = relative(square + found.sigma);
    return {.error = std::max(error, share * most),
            .uncertainty = most - error,
            .points = found.points,
            .rays = found.rays};
}

} // namespace

double reflected_square(const Mesh& mesh, const Solution& solution) {
    const std::vector<double> squares = reflected_squares(mesh, solution.radiosity);
    double sum = 0;
    for (std::size_t i = 0; i < squares.size(); ++i)
        sum += solution.weight_of(i) * squares[i];
    return sum;
}

DivisionError spread_error(const Mesh& mesh, const Tracer& tracer, const Solution& solution,
                           bool reads_near, const DivisionErrorOptions& options,
                           const Workers& workers, const StopFlag& interrupted) {
    if (!(surface_square(mesh, solution) > 0))
        return {};
    const SquaredError found =
        error_of_gathers({mesh, tracer, solution}, reads_near, options, workers, interrupted);
    return interrupted ? DivisionError{} : reported(found);
}

DivisionError gathered_error(const DivisionError& spread, const Mesh& mesh,
                             const Solution& solution) {
    // If N rays met nothing, a share of 3 / N may have been missed, the rule of three. The mean
    // square of the missed share, if all shares are equally likely before, is 2 / N^2.
    constexpr double mean_of_missed = 2 / (rule_of_three * rule_of_three);
    const double size = reflected_square(mesh, solution), rho = mean_reflectance(mesh);
    const double sampled = estimated_error(mesh, solution), square = sampled * sampled;
    const double missed = solution.missed / size, level = solution.variance_of_level / size;
    // What is missed, and the level of all light, is common to all that a gather reads.
    double sampling = rho * sampled;
    if (solution.reflected_share)
        sampling = std::sqrt(rho * rho * (mean_of_missed * missed + level) +
                             *solution.reflected_share * std::max(square - missed - level, 0.0));
    DivisionError all = spread;
    all.error = std::hypot(spread.error, sampling);
    if (all.error > 0)
        all.uncertainty =
            std::hypot(spread.error * spread.uncertainty,
                       sampling * sampling * error_spread(mesh, solution).uncertainty()) /
            all.error;
    return all;
}

DivisionError division_error(const Mesh& mesh, const Tracer& tracer, const Solution& solution,
                             const DivisionErrorOptions& options, const Workers& workers,
                             const StopFlag& interrupted) {
    const double size = surface_square(mesh, solution);
    if (!(size > 0))
        return {};
    const LightSource light{mesh, tracer, solution};
    const KnownVariance known = known_variance(mesh, solution, size);
    // In what patches err together, a gather errs with them, except for what a reflection takes
    // away.
    const double rho = mean_reflectance(mesh);
    const double seen = known.own + known.common * (1 - rho) * (1 - rho);
    SquaredError all =
        error_within_patches(light, {seen, seen * known.scatter()}, options, workers, interrupted);
    const double least = std::sqrt(std::max(all.square, known.own + known.common));
    if (least > 0) {
        DivisionErrorOptions of_others = options;
        of_others.seed = hash_words({options.seed, 1});
        of_others.negligible = std::max(share_of_spread * least, options.negligible);
        all.add(error_of_spread(light, of_others, workers, interrupted));
    }
    return interrupted ? DivisionError{} : reported(all);
}

std::vector<double> patch_error_levels(const Mesh& mesh, const Tracer& tracer,
                                       const Solution& solution, std::uint64_t seed,
                                       const Workers& workers, const StopFlag& interrupted) {
    std::vector<std::uint32_t> all(mesh.patches().size());
    std::iota(all.begin(), all.end(), 0u);
    const LightWithinPatches within =
        light_within_patches({mesh, tracer, solution}, all, {.seed = seed}, workers, interrupted);
    if (interrupted)
        return {};
    std::vector<double> levels(mesh.patches().size());
    const double size = reflected_square(mesh, solution);
    if (!(size > 0))
        return levels;
    double area = 0;
    for (std::uint32_t i = 0; i < levels.size(); ++i)
        area += solution.weight_of(i) * mesh.patches()[i].area;
    for (std::uint32_t i = 0; i < levels.size(); ++i) {
        const Vec3& sigma = solution.standard_error[i];
        const double sampling = glm::dot(sigma, sigma) * area / size;
        const Patch& patch = mesh.patches()[i];
        double off = within.square[i];
        if (solution.slope.empty())
            off += patch.area * variance_of(patch, agreed_slope(patch, within.slopes[i]).slope);
        const double of_place = patch.area > 0 ? off / size * area / patch.area : 0;
        levels[i] = std::sqrt(std::max(of_place, 0.0) + (std::isfinite(sampling) ? sampling : 0));
    }
    return levels;
}

} // namespace hemilux
