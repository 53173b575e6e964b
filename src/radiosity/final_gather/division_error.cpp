#include "radiosity/final_gather/division_error.h"

#include "radiosity/final_gather/final_gather.h"
#include "radiosity/final_gather/light_within_patches.h"
#include "radiosity/final_gather/linear_light.h"
#include "radiosity/rays/shot.h"
#include "radiosity/sampling/rng.h"
#include "radiosity/sampling/workers.h"
#include "radiosity/scene/mesh.h"
#include "radiosity/solving/error_spread.h"
#include "radiosity/solving/solution.h"
#include "radiosity/solving/stop_flag.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <vector>

namespace hemilux {
namespace {

/// Rounds of points: many, since the spread of a few would end them when it happens to be small.
constexpr std::size_t least_rounds = 16;

/// What depends on how the error varies over the surfaces: of patches few hold most of it, that of
/// gathered light is much the same everywhere.
struct Manner {
    std::size_t points_per_round;
    /// Noise of a gather beside the error that it is to find, both squared.
    double noise_beside_error;
    /// Whether a few points say how long gathers are to be. Where their noise hides the error, what
    /// is negligible says it.
    bool by_first_points;
};
constexpr Manner of_patches{64, 4, true}, of_gathered{16, 16, false};

/// By which the length of gathers is chosen.
constexpr std::size_t first_rounds = 4;

/// Relative uncertainty of the squared error at which it is known well enough.
constexpr double well_known = .25;

/// Sums over independent rounds of points.
struct Rounds {
    double sum = 0, squares = 0;
    std::size_t count = 0;

    void add(double value) {
        sum += value;
        squares += value * value;
        ++count;
    }
    [[nodiscard]] double mean() const { return sum / static_cast<double>(count); }
    /// One sigma of the mean.
    [[nodiscard]] double uncertainty() const {
        const auto n = static_cast<double>(count);
        return std::sqrt(std::max(squares / n - mean() * mean(), 0.0) / (n - 1));
    }
};

/// Integrals over the surfaces, by one set of points.
struct Products {
    double error = 0; ///< of (g1 - B)(g2 - B)
    double noise = 0; ///< of (g1 - g2)^2 / 2
};

/// By how much B is off at a point, from one gather there [W/m2].
using OffAt = std::function<Vec3(const PatchPoint& point, const Vec3& gathered)>;

Products products_over_surface(const Mesh& mesh, const OffAt& off_at, FinalGather& gather,
                               const PointsOverSurface& surface, std::size_t count,
                               std::uint64_t seed, const Workers& workers,
                               const StopFlag& interrupted) {
    const auto [points, irradiance] =
        gather_twice(surface, gather, count, seed, workers, interrupted);
    Products sums;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const Vec3& rho = mesh.material(points[k].patch).reflectance;
        const Vec3 off1 = off_at(points[k], rho * irradiance[2 * k]);
        const Vec3 off2 = off_at(points[k], rho * irradiance[2 * k + 1]);
        sums.error += points[k].area * glm::dot(off1, off2);
        sums.noise += points[k].area * .5 * glm::dot(off1 - off2, off1 - off2);
    }
    return sums;
}

/// Half of the points by area, half by the squared error.
std::vector<double> density_of_points(const Mesh& mesh, std::span<const double> square) {
    double area = 0, sum = 0;
    for (std::size_t i = 0; i < square.size(); ++i) {
        area += mesh.patches()[i].area;
        sum += std::max(square[i], 0.0);
    }
    std::vector<double> density;
    for (std::size_t i = 0; i < square.size() && sum > 0; ++i)
        density.push_back(.5 + .5 * std::max(square[i], 0.0) / sum * area / mesh.patches()[i].area);
    return density;
}

/// How long gathers are to be, in units of the shortest. The variance of a product is about
/// (error^2 + noise^2 / length)^2, so that long ones know a small error sooner than many short
/// ones; more points are needed anyway, as the error is not the same everywhere.
unsigned length_of_gathers(double error_square, double noise_square, const Manner& manner) {
    const double longest = 4096.0 / double(manner.points_per_round);
    const double length = noise_square / (manner.noise_beside_error * error_square);
    return static_cast<unsigned>(std::clamp(std::round(length), 1.0, longest));
}

/// The variance of the patches' values, relative to their square, in its two parts.
struct KnownVariance {
    double own = 0;     ///< of what patches err each for itself
    double common = 0;  ///< of what they err together
    double freedom = 1; ///< effective degrees of freedom
};

KnownVariance known_variance(const Mesh& mesh, const Solution& solution, double size) {
    double sum = 0;
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i) {
        const Vec3& sigma = solution.standard_error[i];
        sum += mesh.patches()[i].area * glm::dot(sigma, sigma);
    }
    const double all = solution.variance.value_or(std::isfinite(sum) ? sum : 0) / size;
    const double freedom = std::max(error_spread(mesh, solution).freedom, 1.0);
    return {all * (1 - 1 / freedom), all / freedom, freedom};
}

/// What is not of the division, relative to the square of the patches' values as all else. One
/// error is not as large as errors are on average: its square scatters by 2 / parts.
struct OtherError {
    double square = 0, scatter = 0;
};

/// `rounds`: of all of the error. The square of the light itself is larger by that of the error.
void set_error(DivisionError& result, const Rounds& rounds, const OtherError& other) {
    const auto relative = [](double square) { return std::sqrt(square / (1 + square)); };
    const double square = std::max(rounds.mean() - other.square, 0.0);
    const double sigma = std::hypot(rounds.uncertainty(), other.scatter);
    result.error = relative(square);
    // The root's, where it is well known; else how large it may be.
    result.uncertainty = relative(square + sigma) - result.error;
}

/// What the gather misses is off.
Vec3 missing_at(const PatchPoint&, const Vec3& missing) { return missing; }

DivisionError error_at_points(const Mesh& mesh, double size, const OffAt& off_at,
                              FinalGather& gather, const OtherError& other, const Manner& manner,
                              const DivisionErrorOptions& options, const Workers& workers,
                              const StopFlag& interrupted) {
    DivisionError result;
    const double negligible = options.negligible * options.negligible;
    const PointsOverSurface surface(mesh, density_of_points(mesh, options.square));
    const auto products = [&](std::uint64_t number) {
        const Products sums =
            products_over_surface(mesh, off_at, gather, surface, manner.points_per_round,
                                  hash_words({options.seed, number}), workers, interrupted);
        return Products{sums.error / size, sums.noise / size};
    };
    Rounds first, noise;
    for (std::size_t k = 0; k < first_rounds && !interrupted; ++k) {
        const Products found = products(k);
        first.add(found.error);
        noise.add(found.noise);
    }
    const double expected =
        std::max({manner.by_first_points ? first.mean() : 0, other.square, negligible});
    gather.set_rounds(length_of_gathers(expected, noise.mean(), manner));
    Rounds rounds;
    while (rounds.count < least_rounds || gather.rays() < options.most_rays) {
        const double product = products(first_rounds + rounds.count).error;
        if (interrupted)
            return result;
        rounds.add(product);
        const double enough = std::max(well_known * (rounds.mean() - other.square), negligible);
        if (rounds.count >= least_rounds && rounds.uncertainty() <= enough)
            break;
    }
    set_error(result, rounds, other);
    result.points = rounds.count * manner.points_per_round;
    result.rays = gather.rays();
    return result;
}

} // namespace

double reflected_square(const Mesh& mesh, const Solution& solution) {
    double sum = 0;
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i) {
        const Vec3 reflected = solution.radiosity[i] - mesh.material(i).emission;
        sum += mesh.patches()[i].area * glm::dot(reflected, reflected);
    }
    return sum;
}

DivisionError division_error(const Mesh& mesh, const Tracer& tracer, const Solution& solution,
                             const DivisionErrorOptions& options, const Workers& workers,
                             const StopFlag& interrupted) {
    const double size = reflected_square(mesh, solution);
    if (!(size > 0))
        return {};
    const KnownVariance known = known_variance(mesh, solution, size);
    const double scatter = std::sqrt(2 / known.freedom), rho = mean_reflectance(mesh);
    // Of what patches err together a gather errs with them, but for what a reflection takes away.
    const double seen = known.own + known.common * (1 - rho) * (1 - rho);
    FinalGather gather(mesh, tracer, solution);
    const OffAt off_at = [&](const PatchPoint& point, const Vec3& gathered) {
        return gathered - (radiosity_at(mesh, solution, point.patch, point.at.position) -
                           mesh.material(point.patch).emission);
    };
    DivisionError found = error_at_points(mesh, size, off_at, gather, {seen, seen * scatter},
                                          of_patches, options, workers, interrupted);
    DivisionErrorOptions of_spread = options;
    of_spread.seed = hash_words({options.seed, 1});
    of_spread.negligible = std::max(found.error, std::sqrt(known.own + known.common)) / 3;
    of_spread.square = {};
    if (!(of_spread.negligible > 0))
        return found;
    FinalGather missing(mesh, tracer, solution);
    missing.find_missing(false);
    const double spread_by_sampling = known.common * rho * rho;
    const DivisionError spread = error_at_points(mesh, size, missing_at, missing,
                                                 {spread_by_sampling, spread_by_sampling * scatter},
                                                 of_gathered, of_spread, workers, interrupted);
    const double both = std::hypot(found.error, spread.error);
    if (both > 0)
        found.uncertainty =
            std::hypot(found.error * found.uncertainty, spread.error * spread.uncertainty) / both;
    found.error = both;
    found.rays += spread.rays;
    return found;
}

DivisionError gathered_error(const Mesh& mesh, const Tracer& tracer, const Solution& solution,
                             bool reads_near, const DivisionErrorOptions& options,
                             const Workers& workers, const StopFlag& interrupted) {
    const double size = reflected_square(mesh, solution);
    if (!(size > 0))
        return {};
    FinalGather gather(mesh, tracer, solution);
    gather.find_missing(reads_near);
    DivisionError found = error_at_points(mesh, size, missing_at, gather, {}, of_gathered, options,
                                          workers, interrupted);
    found.error = std::max(found.error, found.uncertainty); // which it may be
    return found;
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
    for (const Patch& patch : mesh.patches())
        area += patch.area;
    for (std::uint32_t i = 0; i < levels.size(); ++i) {
        const Vec3& sigma = solution.standard_error[i];
        const double sampling = glm::dot(sigma, sigma) * area / size;
        const Patch& patch = mesh.patches()[i];
        double off = within.square[i];
        if (solution.slope.empty()) {
            const Vec3 variance = variance_of(patch, agreed_slope(patch, within.slopes[i]).slope);
            off += patch.area * (variance.x + variance.y + variance.z);
        }
        const double of_place = patch.area > 0 ? off / size * area / patch.area : 0;
        levels[i] = std::sqrt(std::max(of_place, 0.0) + (std::isfinite(sampling) ? sampling : 0));
    }
    return levels;
}

} // namespace hemilux
