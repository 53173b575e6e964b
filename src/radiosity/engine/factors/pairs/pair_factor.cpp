#include "radiosity/engine/factors/pairs/pair_factor.h"

#include "radiosity/engine/factors/pairs/point_to_patch.h"
#include "radiosity/engine/sampling/sobol.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <numeric>

namespace hemilux {
namespace {

/// A pair of less importance gets as many rays as its importance, in two batches of points: they
/// are too few to judge by.
constexpr double min_importance_to_adapt = 32;

/// Other pairs get from a quarter to four times their importance in rays, in four batches, whose
/// agreement is seldom chance. Rays are added until the variance is that of `importance` points
/// with this relative variance each.
constexpr double min_share = 0.25, max_share = 4;
constexpr std::uint32_t adaptive_batches = 4;
constexpr double relative_variance = 0.03;

/// The largest number of rays of a pair, whatever its importance.
constexpr double max_rays = 8192;

/// Returns the number of points of each batch, a power of two, for which they are best distributed.
std::uint32_t points_per_batch(double rays, std::uint32_t batches) {
    const double points = std::clamp(rays, 2.0, max_rays) / batches;
    return std::bit_ceil(static_cast<std::uint32_t>(std::max(points, 1.0)));
}

} // namespace

void PairFactor::average(std::span<const double> sums, double points_each) {
    const auto batches = static_cast<double>(sums.size());
    factor = std::accumulate(sums.begin(), sums.end(), 0.0) / (batches * points_each);
    double squares = 0;
    for (const double sum : sums)
        squares += (sum / points_each - factor) * (sum / points_each - factor);
    variance = squares / (batches * (batches - 1));
}

bool may_see(const Patch& a, const Patch& b) {
    // Neighbours in one plane are in front of each other by rounding errors only. These are errors
    // of their places, which may be coarse far from a file's origin. Walls may be nearer than that.
    constexpr double min_slope = 1e-7;
    const double min_height = 1e-12 + min_slope * glm::distance(a.centre, b.centre);
    const auto reaches_above = [&](const Patch& patch, const Patch& plane) {
        return std::ranges::any_of(patch.shape.corner, [&](const Vec3& corner) {
            return glm::dot(plane.normal, corner - plane.centre) > min_height;
        });
    };
    return reaches_above(a, b) && reaches_above(b, a);
}

double rough_factor(const Patch& from, const Patch& to) {
    const Vec3 d = to.centre - from.centre;
    const double r2 = glm::dot(d, d), r = std::sqrt(r2);
    const double min_cosine = (std::sqrt(from.area) + std::sqrt(to.area)) / (2 * r);
    const auto cosine = [&](double at_centres) {
        return std::min(std::max(min_cosine, at_centres), 1.0); // 1 for a NaN of equal centres
    };
    return cosine(glm::dot(from.normal, d) / r) * cosine(-glm::dot(to.normal, d) / r) * to.area /
           (std::numbers::pi * r2 + to.area);
}

PairFactor pair_factor(const Mesh& mesh, const Tracer& tracer, std::uint32_t from, std::uint32_t to,
                       double importance, std::uint64_t seed, bool visibility) {
    const bool adaptive = importance >= min_importance_to_adapt;
    const std::uint32_t batches = adaptive ? adaptive_batches : 2;
    const std::uint32_t most =
        points_per_batch(adaptive ? max_share * importance : importance, batches);
    const PairLook look(mesh, tracer, from, to, near_radii * radius_of(mesh.patches()[to]),
                        visibility);
    PairFactor result;
    std::array<double, adaptive_batches> sum{};
    std::uint32_t first_batch = 0;
    const auto look_at_points = [&](std::uint32_t begin, std::uint32_t end) {
        for (std::uint32_t batch = 0; batch < batches; ++batch) {
            SobolBlocks<4> points(hash_words({seed, from, first_batch + batch}));
            result.points += end - begin;
            for (std::uint32_t k = begin; k < end; ++k) {
                const double f = look.factor(points.at(k), result.rays);
                sum[batch] += f;
                result.hits += f > 0;
            }
        }
        result.average({sum.data(), batches}, end);
    };
    std::uint32_t begin = 0,
                  end = adaptive ? points_per_batch(min_share * importance, batches) : most;
    for (;; begin = end, end *= 2) {
        look_at_points(begin, end);
        // There may be a gap all the same. Pairs that met something go on to `most` points, of
        // which these are a share. As many other points stand for the rest.
        if (result.hits == 0 && end < most) {
            first_batch = batches;
            look_at_points(0, end);
            const double rest = 1 - double(end) / most;
            result.factor *= rest;
            result.variance *= rest;
            return result;
        }
        const double allowed = relative_variance * result.factor * result.factor / importance;
        if (end >= most || result.variance <= allowed) {
            // Stopping when the batches agree means stopping when they happen to, so the variance
            // is not taken to be less than allowed.
            if (adaptive)
                result.variance = std::max(result.variance, allowed);
            return result;
        }
    }
}

} // namespace hemilux
