#include "app/gathering/target_light.h"

#include "app/gathering/learn_options.h"
#include "geometry/elementary.h"
#include "geometry/polygon_sampler.h"
#include "parallel/stopwatch.h"
#include "parallel/workers.h"
#include "radiosity/light/cached_light/light_cache.h"
#include "radiosity/light/final_gather/light_at_points.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"

#include <cmath>
#include <vector>

namespace hemilux {
namespace {

/// The points of a patch lie in rows and columns of equal pieces: these of few patches, half as
/// many of many.
constexpr std::size_t max_rows = 4, many_patches = 512;

/// The shares of the error that what gathers read, and the noise of their rays, may leave.
constexpr double share_of_learned = .7, share_of_rays = .5;

/// The part of a target that one of its patches is.
TargetPart part_of(const Mesh& mesh, std::uint32_t i, double weight, std::size_t rows,
                   std::uint64_t seed) {
    const Patch& patch = mesh.patches()[i];
    const PolygonSampler sampler(patch.shape);
    Rng rng(hash_words({seed, i}));
    TargetPart part{{}, {}, weight * patch.area};
    for (std::size_t k = 0; k < 2 * rows * rows; ++k) {
        const std::size_t piece = k / 2;
        const double u = rng.uniform(), v = rng.uniform();
        const Vec3 point = sampler.sample(
            {(double(piece % rows) + u) / double(rows), (double(piece / rows) + v) / double(rows)});
        part.points.push_back({point, patch.normal, patch.facet, i});
        part.reflectance.push_back(colours_at(mesh, patch, point).reflectance);
    }
    return part;
}

/// The light of a patch from that at its points.
struct PatchMean {
    Vec3 reflected{0.0}, variance{0.0};

    PatchMean(const TargetPart& part, std::span<const PointLight> lights) {
        const auto pieces = static_cast<double>(lights.size()) / 2;
        for (std::size_t k = 0; k < lights.size(); k += 2) {
            const Vec3 one = part.reflectance[k] * lights[k].irradiance,
                       other = part.reflectance[k + 1] * lights[k + 1].irradiance;
            reflected += (one + other) / (2 * pieces);
            variance += (one - other) * (one - other) / (4 * pieces * pieces);
        }
    }
};

} // namespace

bool gathers_target(const SolveSettings& settings) {
    const TargetSettings& target = settings.target;
    return !target.camera && (!target.groups.empty() || !target.points.empty()) &&
           !settings.divide_auto && !settings.stop.steps;
}

void gather_target(const SolveSettings& settings, const LitScene& scene, Solution& solution,
                   Monitor& monitor, Statistics& statistics) {
    const Stopwatch watch;
    const Workers workers(settings.options.threads);
    const Mesh& mesh = scene.mesh;
    constexpr double usual_error = .01;
    const double error = settings.stop.error.value_or(usual_error);
    std::vector<std::uint32_t> patches;
    std::vector<TargetPart> parts;
    std::vector<Sensor> sensors;
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i)
        if (solution.weight_of(i) > 0 && mesh.material(i).reflectance != Vec3(0.0))
            patches.push_back(i);
    const std::size_t rows = patches.size() > many_patches ? max_rows / 2 : max_rows,
                      points_of_patch = 2 * rows * rows;
    for (const std::uint32_t i : patches) {
        parts.push_back(part_of(mesh, i, solution.weight_of(i), rows, settings.options.seed));
        for (const SurfacePoint& point : parts.back().points)
            sensors.push_back({point, i});
    }
    LightCache cache(mesh, scene.tracer, solution);
    const LearnOptions options =
        learn_options(settings, share_of_learned * error, hash_words({settings.options.seed, 8}),
                      solution, statistics);
    const ReadError read = cache.learn(parts, options, workers, monitor.interrupted);
    if (monitor.interrupted)
        return;
    const LightAtPoints found =
        light_at(sensors, mesh, scene.tracer, cache.light(),
                 {.noise = share_of_rays * error * std::sqrt(double(points_of_patch)),
                  .seed = hash_words({settings.options.seed, 9}),
                  .give_up = [&] { return bool(monitor.interrupted); }},
                 workers);
    if (monitor.interrupted)
        return;
    double noise = 0, light = 0;
    for (std::size_t k = 0; k < patches.size(); ++k) {
        const std::uint32_t i = patches[k];
        const PatchMean mean(parts[k],
                             std::span(found.lights).subspan(k * points_of_patch, points_of_patch));
        const Vec3 of_read(read.error * read.level);
        solution.radiosity[i] = mesh.material(i).emission + mean.reflected;
        solution.standard_error[i] = glm::sqrt(mean.variance + of_read * of_read);
        noise += parts[k].weight * (mean.variance.x + mean.variance.y + mean.variance.z);
        light += parts[k].weight * glm::dot(mean.reflected, mean.reflected);
    }
    const double own = light > 0 ? std::sqrt(noise / light) : 0;
    statistics.estimated_error = elementary::hypot(read.error, own);
    statistics.error_bound = elementary::hypot(read.bound, own);
    statistics.estimated_error_uncertainty = read.uncertainty;
    statistics.rays_learn += read.rays;
    statistics.rays_gather += found.rays;
    statistics.seconds_learn += watch.seconds();
}

} // namespace hemilux
