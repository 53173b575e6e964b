#include "radiosity/final_gather/division_error.h"

#include "parallel/workers.h"
#include "radiosity/final_gather/final_gather.h"
#include "radiosity/final_gather/light_within_patches.h"
#include "radiosity/final_gather/linear_light.h"
#include "radiosity/rays/shot.h"
#include "radiosity/sampling/rng.h"
#include "radiosity/scene/mesh.h"
#include "radiosity/solution/error_spread.h"
#include "radiosity/solution/missed_light.h"
#include "radiosity/solution/solution.h"
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

/// What depends on how the error varies over the surfaces: of patches few hold most of it, of those
/// that were divided very few, where nothing was seen of it; that of gathered light is much the
/// same everywhere.
struct Manner {
    /// At first; where gathers are longer, fewer by their length, but so many at least.
    std::size_t points_per_round, least_points;
    /// Relative uncertainty of the squared error at which it is known well enough: where few places
    /// hold it, what is known of its spread is uncertain itself.
    double well_known;
    /// What is negligible is found out all the same where so many rays do.
    std::uint64_t cheap_rays;
    /// Gathers at a point, which share a round of rays for two. The mean of the products of all
    /// pairs of n has n / (2 n - 2) times the variance by noise of one product of two.
    unsigned gathers;
};
constexpr Manner of_patches{64, 64, .15, 0, 2}, of_divided{640, 64, .15, 0, 2},
    of_spread{32, 32, .2, 0, 2}, of_gathered{32, 32, .17, 600'000, 8};

/// So many points times the length of gathers at the most, in a round.
constexpr std::size_t longest_round = 4096;

/// Of the error within patches, as what has spread to others is found out.
constexpr double share_of_spread = .4;

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
    double error = 0;    ///< of (g1 - B)(g2 - B)
    double by_noise = 0; ///< variance of `error` by the noise of gathers alone, about
};

/// By how much B is off at a point, from one gather there [W/m2].
using OffAt = std::function<Vec3(const PatchPoint& point, const Vec3& gathered)>;

/// The variance of the patches' values, relative to their square, in its two parts.
struct KnownVariance {
    double own = 0;     ///< of what patches err each for itself
    double common = 0;  ///< of what they err together
    double freedom = 1; ///< effective degrees of freedom

    /// One error is not as large as errors are on average: by how much its square scatters [-].
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

/// What is not of the division, relative to the square of the patches' values as all else.
struct OtherError {
    double square = 0, scatter = 0;
};

/// Relative to the square of what the solution has on the surfaces.
struct SquaredError {
    double square = 0; ///< an estimate, which may be negative
    double sigma = 0;  ///< one, of `square`
    std::size_t points = 0;
    std::uint64_t rays = 0;

    /// Errors that do not depend on each other.
    void add(const SquaredError& other) {
        square += other.square;
        sigma = std::hypot(sigma, other.sigma);
        rays += other.rays;
    }
};

/// Where it is hardly known it is reported nearly as large as it may be.
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

/// reflected_square(), and the square of what the solution has within patches: with that of the
/// error it is the square of the light itself.
double surface_square(const Mesh& mesh, const Solution& solution) {
    double sum = reflected_square(mesh, solution);
    for (std::uint32_t i = 0; i < solution.slope.size(); ++i) {
        const Patch& patch = mesh.patches()[i];
        sum += solution.weight_of(i) * patch.area * variance_of(patch, solution.slope[i]);
    }
    return sum;
}

/// Gathers from a solution at points of the surfaces.
class ErrorAtPoints {
  public:
    /// All outlive it.
    ErrorAtPoints(const Mesh& mesh, const Tracer& tracer, const Solution& solution,
                  const Workers& workers, const StopFlag& interrupted)
        : mesh_(mesh), tracer_(tracer), solution_(solution), workers_(workers),
          interrupted_(interrupted), size_(surface_square(mesh, solution)) {}

    /// All errors are relative to it.
    [[nodiscard]] double size() const { return size_; }
    [[nodiscard]] SquaredError within_patches(const OtherError& other,
                                              const DivisionErrorOptions& options) const;
    /// It varies little over the surfaces.
    [[nodiscard]] SquaredError spread(bool reads_near, const Manner& manner,
                                      const DivisionErrorOptions& options) const;

  private:
    [[nodiscard]] SquaredError find(const OffAt& off_at, FinalGather& gather,
                                    const PointsOverSurface& surface, const OtherError& other,
                                    const Manner& manner,
                                    const DivisionErrorOptions& options) const;
    [[nodiscard]] Products products(const OffAt& off_at, FinalGather& gather,
                                    const PointsOverSurface& surface, std::size_t count,
                                    std::size_t gathers, std::uint64_t seed) const;

    const Mesh& mesh_;
    const Tracer& tracer_;
    const Solution& solution_;
    const Workers& workers_;
    const StopFlag& interrupted_;
    double size_;
};

SquaredError ErrorAtPoints::within_patches(const OtherError& other,
                                           const DivisionErrorOptions& options) const {
    FinalGather gather(mesh_, tracer_, solution_);
    const OffAt off_at = [&](const PatchPoint& point, const Vec3& light) {
        return light - (radiosity_at(mesh_, solution_, point.patch, point.at.position) -
                        mesh_.material(point.patch).emission);
    };
    const PointsOverSurface surface(
        mesh_, mixed_density(mesh_, solution_.weight,
                             {reflected_squares(mesh_, solution_.radiosity), options.square}));
    return find(off_at, gather, surface, other, options.square.empty() ? of_patches : of_divided,
                options);
}

SquaredError ErrorAtPoints::spread(bool reads_near, const Manner& manner,
                                   const DivisionErrorOptions& options) const {
    FinalGather gather(mesh_, tracer_, solution_,
                       2 * FinalGather::usual_random_rays / manner.gathers);
    gather.find_spread(reads_near);
    const OffAt lacking = [](const PatchPoint&, const Vec3& lacks) { return lacks; };
    return find(lacking, gather, PointsOverSurface(mesh_, solution_.weight), {}, manner, options);
}

/// Gathers are short at first. The variance of a product is about (error^2 + noise^2)^2, so where
/// noise leaves too much uncertainty longer gathers know the error sooner than more points would.
/// They begin anew, as a sum that ends by its own spread is biased.
SquaredError ErrorAtPoints::find(const OffAt& off_at, FinalGather& gather,
                                 const PointsOverSurface& surface, const OtherError& other,
                                 const Manner& manner, const DivisionErrorOptions& options) const {
    // For f times less noise longer gathers, which begin anew, cost f times the rays so far, and
    // more points f^2 - 1 times.
    constexpr double barely_negligible = .01, growth_pays = 1.6, least_growth = 2, most_growth = 4;
    const double negligible = options.negligible * options.negligible;
    const auto longest = double(longest_round / manner.least_points);
    double length = 1;
    std::size_t points = manner.points_per_round;
    Rounds rounds, noise;
    double uncertainty = 0;
    for (std::uint64_t number = 0;; ++number) {
        const Products sums = products(off_at, gather, surface, points, manner.gathers,
                                       hash_words({options.seed, number}));
        if (interrupted_)
            return {};
        rounds.add(sums.error / size_);
        noise.add(sums.by_noise / (size_ * size_));
        if (rounds.count < least_rounds)
            continue;
        const double enough = std::max(
            manner.well_known * (rounds.mean() - other.square),
            gather.rays() < manner.cheap_rays ? barely_negligible * negligible : negligible);
        // Rounds may be alike by chance: they differ at least by the noise within them.
        const double by_noise = std::sqrt(noise.mean() / static_cast<double>(noise.count));
        uncertainty = std::max(rounds.uncertainty(), by_noise);
        if (uncertainty <= enough)
            break;
        const auto rays = double(gather.rays()), most_rays = double(options.most_rays);
        const double growth =
            std::clamp(std::min(by_noise / enough, most_rays / rays), least_growth, most_growth);
        if (growth_pays * enough < by_noise && length < longest && growth * rays <= most_rays) {
            length = std::min(std::round(growth * length), longest);
            gather.set_rounds(static_cast<unsigned>(length));
            points = std::max(manner.least_points,
                              manner.points_per_round / static_cast<std::size_t>(length));
            rounds = noise = {};
        } else if (rays >= most_rays) {
            break;
        }
    }
    return {rounds.mean() - other.square, std::hypot(uncertainty, other.scatter),
            rounds.count * points, gather.rays()};
}

Products ErrorAtPoints::products(const OffAt& off_at, FinalGather& gather,
                                 const PointsOverSurface& surface, std::size_t count,
                                 std::size_t gathers, std::uint64_t seed) const {
    const auto [points, irradiance] =
        gather_over(surface, gather, count, gathers, seed, workers_, interrupted_);
    const auto n = static_cast<double>(gathers);
    Products sums;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const Vec3& rho = mesh_.material(points[k].patch).reflectance;
        Vec3 sum(0.0);
        double squares = 0;
        for (std::size_t e = 0; e < gathers; ++e) {
            const Vec3 off = off_at(points[k], rho * irradiance[k * gathers + e]);
            sum += off;
            squares += glm::dot(off, off);
        }
        const double counts = solution_.weight_of(points[k].patch) * points[k].area;
        sums.error += counts * (glm::dot(sum, sum) - squares) / (n * (n - 1));
        // Of normal noise the squared sample variance is (n + 1) / (n - 1) times what it should be.
        const double noise = counts * (squares - glm::dot(sum, sum) / n) / (n - 1);
        sums.by_noise += noise * noise * 2 / (n * (n + 1));
    }
    return sums;
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
    const ErrorAtPoints at_points(mesh, tracer, solution, workers, interrupted);
    if (!(at_points.size() > 0))
        return {};
    const SquaredError found = at_points.spread(reads_near, of_gathered, options);
    return interrupted ? DivisionError{} : reported(found);
}

DivisionError gathered_error(const DivisionError& spread, const Mesh& mesh,
                             const Solution& solution) {
    // Of N rays that met nothing a share of 3 / N may have been missed, the rule of three; the mean
    // square of what is, if all shares are as likely before, is 2 / N^2.
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
    const ErrorAtPoints at_points(mesh, tracer, solution, workers, interrupted);
    if (!(at_points.size() > 0))
        return {};
    const KnownVariance known = known_variance(mesh, solution, at_points.size());
    // Of what patches err together a gather errs with them, but for what a reflection takes away.
    const double rho = mean_reflectance(mesh);
    const double seen = known.own + known.common * (1 - rho) * (1 - rho);
    SquaredError all = at_points.within_patches({seen, seen * known.scatter()}, options);
    const double least = std::sqrt(std::max(all.square, known.own + known.common));
    if (least > 0) {
        DivisionErrorOptions of_others = options;
        of_others.seed = hash_words({options.seed, 1});
        of_others.negligible = std::max(share_of_spread * least, options.negligible);
        all.add(at_points.spread(false, of_spread, of_others));
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
