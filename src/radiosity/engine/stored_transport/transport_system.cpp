#include "radiosity/engine/stored_transport/transport_system.h"

#include "radiosity/engine/emitters/direct_light.h"
#include "radiosity/engine/form_factors/ray_counts.h"
#include "radiosity/engine/linear/conjugate_gradients.h"
#include "radiosity/engine/linear/unsolved_light.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hemilux {
namespace {

/// The parts of the standard error that may be left where solving ends: for the batches, which say
/// no more than that error, and for the whole.
constexpr double left_of_batches = .25, left_of_all = 1e-2;

/// The limits of residuals, relative to the light: the first is the least. The second, times what a
/// reflection takes away, is the largest for the batches.
constexpr double min_residual = 1e-10, first_residual = 3e-3;

/// Returns the variance of a single one of the values.
Vec3 sample_variance(std::span<const Vec3> values) {
    const auto n = static_cast<double>(values.size());
    Vec3 mean(0.0), squares(0.0);
    for (const Vec3& value : values)
        mean += value / n;
    for (const Vec3& value : values)
        squares += (value - mean) * (value - mean);
    return squares / (n - 1);
}

/// Returns the light straight from lights without extent, of one batch or of all; nothing where
/// there are none.
std::vector<Vec3> light_of_points(const DirectLight& shadow_rays, std::optional<std::size_t> batch,
                                  std::size_t patches) {
    std::vector<Vec3> light;
    const LightOfPoints& points = shadow_rays.of_points();
    for (std::uint32_t i = 0; i < patches && !points.empty(); ++i)
        light.push_back(batch ? points.irradiance(i, *batch) : points.irradiance(i));
    return light;
}

} // namespace

TransportSystem::TransportSystem(const Mesh& mesh, std::span<const std::uint32_t> emitters,
                                 bool closed, const PowerOfPoints& points)
    : surfaces_(mesh), sampled_emission_(surfaces_.emission), closed_(closed), points_(points) {
    for (const Vec3& reflectance : surfaces_.reflectance)
        for (int c = 0; c < 3; ++c)
            lost_at_least_ = std::min(lost_at_least_, 1 - reflectance[c]);
    for (const std::uint32_t emitter : emitters)
        sampled_emission_[emitter] = Vec3(0.0);
}

std::vector<ExchangeMatrix> TransportSystem::factors(std::span<const RayCounts> counts,
                                                     const Workers& workers) const {
    std::vector<ExchangeMatrix> factors(counts.size());
    for_batches(counts.size(), counts[0].own_rows().ranks(), workers,
                [&](std::size_t batch, const Workers& own) {
                    factors[batch] = ExchangeMatrix(surfaces_.area, counts[batch], own);
                });
    return factors;
}

TransportSystem::SolvedBatches TransportSystem::solve_batches(std::span<const ExchangeMatrix> parts,
                                                              const DirectLight& shadow_rays,
                                                              double error,
                                                              std::vector<BatchLight::Light>& light,
                                                              const Workers& workers,
                                                              const StopFlag& interrupted) const {
    const std::size_t batches = parts.size();
    std::vector<std::vector<Vec3>> direct(batches);
    std::vector<Vec3> power(batches);
    const Ranks& ranks = parts[0].own_rows().ranks();
    for_batches(batches, ranks, workers, [&](std::size_t batch, const Workers& own) {
        direct[batch] = straight_light(parts[batch], shadow_rays, batch, own);
        power[batch] = power_arriving(transport(parts[batch]), direct[batch]);
    });
    const Vec3 variance = sample_variance(power);
    // What a residual makes of the light is no larger than its sum over all reflections.
    const double known = std::fmin(left_of_batches * error, first_residual); // unknown: the latter
    const double residual = std::max(known * lost_at_least_, min_residual);
    std::vector<double> left(batches); // residuals that are too large
    for_batches(batches, ranks, workers, [&](std::size_t batch, const Workers& own) {
        left[batch] = solve(parts[batch], std::move(direct[batch]), variance,
                            light_of_points(shadow_rays, batch, area().size()), light[batch], own,
                            residual, interrupted);
    });
    return {*std::ranges::max_element(left), variance, average(light)};
}

/// Solves each batch by itself; then the whole by all threads, from where the batches' mean is.
TransportSystem::Solved TransportSystem::solve(std::span<const RayCounts> counts,
                                               const DirectLight& shadow_rays, double error,
                                               std::vector<BatchLight::Light>& light,
                                               const Workers& workers,
                                               const StopFlag& interrupted) const {
    const std::size_t batches = counts.size();
    std::vector<ExchangeMatrix> parts = factors(counts, workers);
    const SolvedBatches solved =
        solve_batches(parts, shadow_rays, error, light, workers, interrupted);
    ExchangeMatrix all(std::move(parts), workers);
    const double tolerance = left_of_all * solved.error * lost_at_least_;
    const double left =
        solve(all, straight_light(all, shadow_rays, std::nullopt, workers),
              solved.variance / double(batches), light_of_points(shadow_rays, {}, area().size()),
              light[batches], workers, std::max(tolerance, min_residual), interrupted);
    const double max_left = std::max(solved.left, left);
    const double unsolved = max_left > 0 ? unsolved_error(max_left, lost_at_least_) : 0;
    return {std::move(all), unsolved};
}

Transport TransportSystem::transport(const ExchangeMatrix& factors) const {
    return {surfaces_.area, surfaces_.emission, surfaces_.reflectance,
            factors.lost(), factors.rays(),     closed_,
            points_.sent,   points_.escaped,    points_.left_behind};
}

/// Solves for what arrives at each patch in the end, from what `light` holds on.
double TransportSystem::solve(const ExchangeMatrix& factors, std::vector<Vec3> direct,
                              const Vec3& variance, std::span<const Vec3> of_points,
                              BatchLight::Light& light, const Workers& workers, double residual,
                              const StopFlag& interrupted) const {
    scale_direct_light(transport(factors), variance, direct);
    for (std::size_t i = 0; i < of_points.size(); ++i)
        direct[i] += of_points[i];
    const GradientsResult result =
        solve_by_gradients(factors, surfaces_.area, surfaces_.reflectance, direct, light.incident,
                           workers, residual, &interrupted);
    light.energy = balance_energy(transport(factors), light.incident);
    return result.converged ? 0 : result.residual;
}

/// Sets the last to the mean of the batches. Returns the mean's relative standard error, of what is
/// reflected.
double TransportSystem::average(std::vector<BatchLight::Light>& light) const {
    const std::size_t batches = light.size() - 1;
    double squares = 0, size = 0;
    for (std::size_t i = 0; i < surfaces_.area.size(); ++i) {
        Vec3 mean(0.0), of_squares(0.0);
        for (std::size_t batch = 0; batch < batches; ++batch) {
            const Vec3& incident = light[batch].incident[i];
            mean += incident / double(batches);
            of_squares += incident * incident / double(batches);
        }
        light[batches].incident[i] = mean;
        const Vec3 weight = surfaces_.area[i] * surfaces_.reflectance[i] * surfaces_.reflectance[i];
        squares += glm::dot(weight, of_squares - mean * mean) / double(batches - 1);
        size += glm::dot(weight, mean * mean);
    }
    return squares > 0 ? std::sqrt(squares / size) : 0;
}

/// Returns the light straight from the emitting surfaces. It comes by shadow rays, of one batch or
/// of all, and by random rays from the emitters that shadow rays do not reach. A patch without
/// shadow rays has all from the latter: it is black, or they are better there.
std::vector<Vec3> TransportSystem::straight_light(const ExchangeMatrix& factors,
                                                  const DirectLight& shadow_rays,
                                                  std::optional<std::size_t> batch,
                                                  const Workers& workers) const {
    const std::size_t n = surfaces_.area.size();
    std::vector<Vec3> light(n);
    const bool any =
        std::ranges::any_of(sampled_emission_, [](const Vec3& e) { return e != Vec3(0.0); });
    std::vector<Lanes> all(n), some(any ? n : 0);
    for (std::size_t i = 0; i < n; ++i)
        all[i] = factors.scaled(i, surfaces_.emission[i]);
    for (std::size_t i = 0; i < some.size(); ++i)
        some[i] = factors.scaled(i, sampled_emission_[i]);
    factors.for_products(workers, [&](std::size_t begin, std::size_t end) {
        for (auto i = static_cast<std::uint32_t>(begin); i < end; ++i) {
            if (shadow_rays.leaves_surfaces(i)) // an emitter does not light itself
                light[i] = factors.row_times(i, all) -
                           factors.self_factor(i) * (surfaces_.emission[i] - sampled_emission_[i]);
            else if (any)
                light[i] = factors.row_times(i, some);
            light[i] += batch ? shadow_rays.of_surfaces(i, *batch) : shadow_rays.of_surfaces(i);
        }
    });
    factors.own_rows().gather(light);
    return light;
}

} // namespace hemilux
