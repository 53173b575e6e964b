#include "radiosity/light/light_error/division_error.h"

#include "geometry/elementary.h"
#include "parallel/workers.h"
#include "radiosity/light/cached_light/light_cache.h"
#include "radiosity/light/final_gather/light_within_patches.h"
#include "radiosity/light/final_gather/linear_light.h"
#include "radiosity/light/final_gather/surface_points.h"
#include "radiosity/light/light_error/error_at_points.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solution/error_spread.h"
#include "radiosity/paper/solution/solution.h"
#include "radiosity/paper/solving/stop_flag.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace hemilux {
namespace {

/// The light that gathers read is learned to this error at first, and then to this share of the
/// error that they find [-].
constexpr double first_error_of_read = .1, share_of_read = .5;

/// The number of points from which it is learned, and the share of all rays for that.
constexpr std::size_t points_to_learn = 4096;
constexpr std::uint64_t share_of_rays = 2;

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

DivisionError division_error(const Mesh& mesh, const Tracer& tracer, const Solution& solution,
                             const DivisionErrorOptions& options, const Workers& workers,
                             const StopFlag& interrupted) {
    const double size = surface_square(mesh, solution);
    if (!(size > 0))
        return {};
    const KnownVariance known = known_variance(mesh, solution, size);
    const double seen = known.own + known.common;
    const PointsOverSurface surface(
        mesh, mixed_density(mesh, solution.weight,
                            {reflected_squares(mesh, solution.radiosity), options.square}));
    std::vector<TargetPart> parts;
    for (const PatchPoint& point : surface.draw(points_to_learn, hash_words({options.seed, 1})))
        parts.push_back({{point.at},
                         {mesh.material(point.patch).reflectance},
                         solution.weight_of(point.patch) * point.area});
    LightCache cache(mesh, tracer, solution);
    SquaredError all;
    std::uint64_t learned = 0;
    double error_of_read =
        std::max(options.expected > 0 ? share_of_read * options.expected : first_error_of_read,
                 options.negligible);
    for (std::uint64_t attempt = 0;; ++attempt) {
        const ReadError read = cache.learn(parts,
                                           {.seed = hash_words({options.seed, 2, attempt}),
                                            .error = error_of_read,
                                            .max_rays = options.max_rays / share_of_rays},
                                           workers, interrupted);
        learned += read.rays;
        all = error_within_patches({mesh, tracer, solution}, cache.light(),
                                   {seen, seen * known.scatter()}, options, workers, interrupted);
        learned += all.rays;
        if (interrupted)
            return {};
        const double whole = std::sqrt(std::max(all.square + seen, seen));
        all.sigma = elementary::hypot(all.sigma, read.error * whole);
        error_of_read = std::max(share_of_read * whole, options.negligible);
        if (!(read.bound > error_of_read) || learned > options.max_rays)
            break;
    }
    all.rays = learned;
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
