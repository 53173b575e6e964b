#include "radiosity/answers/gathering/light_of_patches.h"

#include "geometry/elementary.h"
#include "geometry/polygon_sampler.h"
#include "parallel/stopwatch.h"
#include "parallel/workers.h"
#include "radiosity/light/cached_light/light_cache.h"
#include "radiosity/light/final_gather/light_at_points.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"

#include <cmath>
#include <span>
#include <vector>

namespace hemilux {
namespace {

/// The points of a patch lie in rows and columns of equal pieces: these of few patches, half as
/// many of many.
constexpr std::size_t max_rows = 4, many_patches = 512;

/// The shares of the error that what gathers read, and the noise of their rays, may leave.
constexpr double share_of_learned = .7, share_of_own_rays = .5;

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

std::optional<Answer<Solution>> gather_patches(const LitScene& scene, const Solution& solution,
                                               const Asked& asked, Monitor& monitor) {
    const Stopwatch watch;
    const Workers workers(asked.threads);
    const Mesh& mesh = scene.mesh;
    std::vector<std::uint32_t> patches;
    std::vector<TargetPart> parts;
    std::vector<Sensor> sensors;
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i)
        if (solution.weight_of(i) > 0 && mesh.material(i).reflectance != Vec3(0.0))
            patches.push_back(i);
    const std::size_t rows = patches.size() > many_patches ? max_rows / 2 : max_rows,
                      points_of_patch = 2 * rows * rows;
    for (const std::uint32_t i : patches) {
        parts.push_back(part_of(mesh, i, solution.weight_of(i), rows, asked.seed));
        for (const SurfacePoint& point : parts.back().points)
            sensors.push_back({point, i});
    }
    LightCache cache(mesh, scene.tracer, solution);
    LearnOptions options{.seed = hash_words({asked.seed, 8}),
                         .error = share_of_learned * asked.error,
                         .accuracy = asked.accuracy};
    options.max_rays = asked.max_rays.value_or(options.max_rays);
    const ReadError read = cache.learn(parts, options, workers, monitor.interrupted);
    if (monitor.interrupted)
        return std::nullopt;
    const LightAtPoints found =
        light_at(sensors, mesh, scene.tracer, cache.light(),
                 {.noise = share_of_own_rays * asked.error * std::sqrt(double(points_of_patch)),
                  .seed = hash_words({asked.seed, 9}),
                  .give_up = [&] { return bool(monitor.interrupted); }},
                 workers);
    if (monitor.interrupted)
        return std::nullopt;
    Answer<Solution> answer{solution, {}, {read.rays, found.rays, 0, 0}};
    double noise = 0, light = 0;
    for (std::size_t k = 0; k < patches.size(); ++k) {
        const std::uint32_t i = patches[k];
        const PatchMean mean(parts[k],
                             std::span(found.lights).subspan(k * points_of_patch, points_of_patch));
        const Vec3 of_read(read.error * read.level);
        answer.value.radiosity[i] = mesh.material(i).emission + mean.reflected;
        answer.value.standard_error[i] = glm::sqrt(mean.variance + of_read * of_read);
        noise += parts[k].weight * (mean.variance.x + mean.variance.y + mean.variance.z);
        light += parts[k].weight * glm::dot(mean.reflected, mean.reflected);
    }
    const double own = light > 0 ? std::sqrt(noise / light) : 0;
    answer.error = {elementary::hypot(read.error, own), elementary::hypot(read.bound, own),
                    read.uncertainty, AnswerError::unknown};
    answer.work.seconds_learn = watch.seconds();
    return answer;
}

} // namespace hemilux
