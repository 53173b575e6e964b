#include "radiosity/light/final_gather/light_at_points.h"

#include "parallel/workers.h"
#include "radiosity/light/final_gather/final_gather.h"
#include "radiosity/paper/rays/receivers.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solution/error_spread.h"
#include "radiosity/paper/solution/solution.h"
#include "radiosity/paper/solving/stop_flag.h"

#include <algorithm>
#include <cmath>

namespace hemilux {
namespace {

/// The number of gathers of a point, independent of each other, whose spread is the error of their
/// mean.
constexpr unsigned gathers = 8;

/// The number of rays traced before give_up is asked again: a fraction of a second.
constexpr std::size_t rays_per_block = 1 << 20;

/// Returns the variance of the light that the rays of a point read, by the standard errors of the
/// patches. Patches have errors of their own, except for a share of 1 / freedom, by which all err
/// together.
Vec3 variance_of_patches(std::span<std::uint32_t> met, const Solution& solution, double freedom) {
    std::ranges::sort(met);
    Vec3 together(0.0), alone(0.0);
    for (std::size_t begin = 0, end = 0; begin < met.size(); begin = end) {
        while (end < met.size() && met[end] == met[begin])
            ++end;
        if (met[begin] == escaped || met[begin] == absorbed)
            break; // the largest numbers
        const double weight = static_cast<double>(end - begin) / static_cast<double>(met.size());
        const Vec3 sigma = weight * solution.standard_error[met[begin]];
        together += sigma;
        alone += sigma * sigma;
    }
    return glm::mix(alone, together * together, 1 / freedom);
}

PointLight mean_of(std::span<const Vec3> estimates) {
    PointLight light;
    for (const Vec3& estimate : estimates)
        light.irradiance += estimate / double(gathers);
    Vec3 squares(0.0);
    for (const Vec3& estimate : estimates)
        squares += (estimate - light.irradiance) * (estimate - light.irradiance);
    light.standard_error = squares / double(gathers * (gathers - 1)); // the variance so far
    return light;
}

} // namespace

Sensor sensor_at(const Mesh& mesh, const Tracer& tracer, const Vec3& position, const Vec3& normal) {
    constexpr double near = 2e-6;             // the local frame is 2 wide
    constexpr double same_direction = .99985; // cosine of a degree
    Ray down{position + near * normal, -normal};
    down.t_max = 2 * near;
    const auto hit = tracer.closest(down);
    const std::uint32_t patch = hit ? mesh.patch_at(*hit) : none;
    if (patch == none || glm::dot(mesh.patches()[patch].normal, normal) < same_direction)
        return {{position, normal, none}, none};
    return {{down.origin + hit->t * down.direction, normal, hit->facet}, patch};
}

std::vector<PointLight> light_at(std::span<const Sensor> sensors, const Mesh& mesh,
                                 const Tracer& tracer, const Solution& solution,
                                 const PointLightOptions& options, const Workers& workers) {
    const unsigned rounds =
        std::max(1u, (options.rays + gathers * FinalGather::usual_random_rays - 1) /
                         (gathers * FinalGather::usual_random_rays));
    const std::size_t rays_of_point =
        std::size_t{gathers} * FinalGather::usual_random_rays * rounds;
    const std::size_t block = std::max<std::size_t>(1, rays_per_block / rays_of_point);
    const double known = error_spread(mesh, solution).freedom;
    const double freedom = known >= 1 ? known : 1;
    FinalGather gather(mesh, tracer, solution);
    std::vector<std::uint32_t> met;
    gather.set_rounds(rounds);
    gather.record_receivers(met);
    const StopFlag never;
    std::vector<PointLight> lights;
    for (std::size_t begin = 0; begin < sensors.size(); begin += block) {
        if (options.give_up && options.give_up())
            return {};
        std::vector<SurfacePoint> at;
        std::vector<std::uint64_t> streams;
        for (const Sensor& sensor :
             sensors.subspan(begin, std::min(block, sensors.size() - begin))) {
            at.push_back(sensor.at);
            streams.push_back(hash_words({options.seed, begin + at.size()}));
        }
        const std::vector<Vec3> estimates = gather.irradiance(at, streams, gathers, workers, never);
        lights.resize(begin + at.size());
        workers.for_chunks(at.size(), 16, [&](std::size_t first, std::size_t end) {
            for (std::size_t k = first; k < end; ++k) {
                PointLight light = mean_of(std::span(estimates).subspan(k * gathers, gathers));
                const Vec3 of_patches = variance_of_patches(
                    std::span(met).subspan(k * rays_of_point, rays_of_point), solution, freedom);
                light.standard_error = glm::sqrt(light.standard_error + of_patches);
                lights[begin + k] = light;
            }
        });
    }
    return lights;
}

} // namespace hemilux
