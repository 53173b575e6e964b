#include "radiosity/light/light_error/error_at_points.h"

#include "geometry/elementary.h"
#include "parallel/workers.h"
#include "radiosity/light/cached_light/patch_light.h"
#include "radiosity/light/final_gather/final_gather.h"
#include "radiosity/light/final_gather/light_within_patches.h"
#include "radiosity/light/final_gather/linear_light.h"
#include "radiosity/light/final_gather/surface_points.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solution/solution.h"
#include "radiosity/paper/solving/stop_flag.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace hemilux {
namespace {

/// The least number of rounds of points: many, since the spread of a few would end them when it
/// happens to be small.
constexpr std::size_t fewest_rounds = 16;

/// The most points times the length of gathers in a round.
constexpr std::size_t longest_round = 4096;

/// The sums over independent rounds of points.
struct Rounds {
    double sum = 0, squares = 0;
    std::size_t count = 0;

    void add(double value) {
        sum += value;
        squares += value * value;
        ++count;
    }
    [[nodiscard]] double mean() const { return sum / static_cast<double>(count); }
    /// Returns one sigma of the mean.
    [[nodiscard]] double uncertainty() const {
        const auto n = static_cast<double>(count);
        return std::sqrt(std::max(squares / n - mean() * mean(), 0.0) / (n - 1));
    }
};

/// The relative uncertainty of the squared error at which it is known well enough.
constexpr double well_known = .15;

/// The numbers of points of a round: very few patches that were divided hold most of the error,
/// where nothing was seen of it. Where gathers are longer, there are fewer by their length.
constexpr std::size_t min_points = 64, points_of_divided = 320;

/// The number of gathers at a point.
constexpr std::size_t gathers_at_point = 2;

/// The integrals over the surfaces, by one set of points.
struct Products {
    double error = 0;    ///< of (g1 - B)(g2 - B)
    double by_noise = 0; ///< variance of `error` by the noise of gathers alone, about
};

/// A function that returns the error of the solution at a point, from one gather there [W/m2].
using OffAt = std::function<Vec3(const PatchPoint& point, const Vec3& gathered)>;

/// Gathers from a solution at points of the surfaces.
class ErrorAtPoints {
  public:
    /// All arguments must outlive this object.
    ErrorAtPoints(const LightSource& light, const OffAt& off_at, FinalGather& gather,
                  const PointsOverSurface& surface, const Workers& workers,
                  const StopFlag& interrupted)
        : light_(light), off_at_(off_at), gather_(gather), surface_(surface), workers_(workers),
          interrupted_(interrupted), size_(surface_square(light.mesh, light.solution)) {}

    [[nodiscard]] SquaredError find(const OtherError& other, std::size_t points_per_round,
                                    const DivisionErrorOptions& options) const;

  private:
    [[nodiscard]] Products products(std::size_t count, std::size_t gathers,
                                    std::uint64_t seed) const;

    const LightSource& light_;
    const OffAt& off_at_;
    FinalGather& gather_;
    const PointsOverSurface& surface_;
    const Workers& workers_;
    const StopFlag& interrupted_;
    double size_; ///< all errors are relative to it
};

/// Gathers are short at first. The variance of a product is about (error^2 + noise^2)^2. So where
/// noise leaves too much uncertainty, longer gathers know the error sooner than more points would.
/// They begin anew, as a sum that ends by its own spread is biased.
SquaredError ErrorAtPoints::find(const OtherError& other, std::size_t points_per_round,
                                 const DivisionErrorOptions& options) const {
    // For f times less noise, longer gathers, which begin anew, cost f times the rays so far, and
    // more points f^2 - 1 times.
    constexpr double growth_pays = 1.6, min_growth = 2, max_growth = 4;
    const double negligible = options.negligible * options.negligible;
    const auto longest = double(longest_round / min_points);
    double length = 1;
    std::size_t points = points_per_round;
    Rounds rounds, noise;
    double uncertainty = 0;
    for (std::uint64_t number = 0;; ++number) {
        const Products sums =
            products(points, gathers_at_point, hash_words({options.seed, number}));
        if (interrupted_)
            return {};
        rounds.add(sums.error / size_);
        noise.add(sums.by_noise / (size_ * size_));
        if (rounds.count < fewest_rounds)
            continue;
        const double enough = std::max(well_known * (rounds.mean() - other.square), negligible);
        // Rounds may be alike by chance: they differ at least by the noise within them.
        const double by_noise = std::sqrt(noise.mean() / static_cast<double>(noise.count));
        uncertainty = std::max(rounds.uncertainty(), by_noise);
        if (uncertainty <= enough)
            break;
        const auto rays = double(gather_.rays()), max_rays = double(options.max_rays);
        const double growth =
            std::clamp(std::min(by_noise / enough, max_rays / rays), min_growth, max_growth);
        if (growth_pays * enough < by_noise && length < longest && growth * rays <= max_rays) {
            length = std::min(std::round(growth * length), longest);
            gather_.set_rounds(static_cast<unsigned>(length));
            points = std::max(min_points, points_per_round / static_cast<std::size_t>(length));
            rounds = noise = {};
        } else if (rays >= max_rays) {
            break;
        }
    }
    return {rounds.mean() - other.square, elementary::hypot(uncertainty, other.scatter),
            rounds.count * points, gather_.rays()};
}

Products ErrorAtPoints::products(std::size_t count, std::size_t gathers, std::uint64_t seed) const {
    const auto [points, irradiance] =
        gather_over(surface_, gather_, count, gathers, seed, workers_, interrupted_);
    const auto n = static_cast<double>(gathers);
    Products sums;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const Vec3& rho = light_.mesh.material(points[k].patch).reflectance;
        Vec3 sum(0.0);
        double squares = 0;
        for (std::size_t e = 0; e < gathers; ++e) {
            const Vec3 off = off_at_(points[k], rho * irradiance[k * gathers + e]);
            sum += off;
            squares += glm::dot(off, off);
        }
        const double counts = light_.solution.weight_of(points[k].patch) * points[k].area;
        sums.error += counts * (glm::dot(sum, sum) - squares) / (n * (n - 1));
        // For normal noise, the squared sample variance is (n + 1) / (n - 1) times what it should
        // be.
        const double noise = counts * (squares - glm::dot(sum, sum) / n) / (n - 1);
        sums.by_noise += noise * noise * 2 / (n * (n + 1));
    }
    return sums;
}

} // namespace

double surface_square(const Mesh& mesh, const Solution& solution) {
    double sum = reflected_square(mesh, solution);
    for (std::uint32_t i = 0; i < solution.slope.size(); ++i) {
        const Patch& patch = mesh.patches()[i];
        sum += solution.weight_of(i) * patch.area * variance_of(patch, solution.slope[i]);
    }
    return sum;
}

SquaredError error_within_patches(const LightSource& light, const SurfaceLight& read,
                                  const OtherError& other, const DivisionErrorOptions& options,
                                  const Workers& workers, const StopFlag& interrupted) {
    const Mesh& mesh = light.mesh;
    const Solution& solution = light.solution;
    FinalGather gather(mesh, light.tracer, read);
    const OffAt off_at = [&](const PatchPoint& point, const Vec3& gathered) {
        return gathered - (radiosity_at(mesh, solution, point.patch, point.at.position) -
                           mesh.material(point.patch).emission);
    };
    const PointsOverSurface surface(
        mesh, mixed_density(mesh, solution.weight,
                            {reflected_squares(mesh, solution.radiosity), options.square}));
    return ErrorAtPoints(light, off_at, gather, surface, workers, interrupted)
        .find(other, options.square.empty() ? min_points : points_of_divided, options);
}

} // namespace hemilux
