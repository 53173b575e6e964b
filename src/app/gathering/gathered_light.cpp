#include "app/gathering/gathered_light.h"

#include "app/division/whole_error.h"
#include "app/rendering/view.h"
#include "app/terminal/stopwatch.h"
#include "io/rendering/picture_parts.h"
#include "parallel/workers.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cmath>

namespace hemilux {
namespace {

/// The shares of the error that what gathers read, and the noise of their rays, may leave.
constexpr double share_of_read = .7, share_of_noise = .6;

/// The most points from which the light that all of them read is learned.
constexpr std::size_t max_learned_points = 65'536;

std::vector<TargetPart> parts_of(std::span<const Sensor> sensors) {
    std::vector<TargetPart> parts;
    const std::size_t each = (sensors.size() + max_learned_points - 1) / max_learned_points;
    for (std::size_t k = 0; k < sensors.size(); k += std::max<std::size_t>(each, 1))
        parts.push_back({{sensors[k].at}, {Vec3(1.0)}});
    return parts;
}

/// Enters the errors of what is read and of noise.
void enter(Statistics& statistics, const ReadError& read, double noise) {
    statistics.estimated_error = std::hypot(read.error, noise);
    statistics.error_bound = std::hypot(read.bound, noise);
    statistics.estimated_error_uncertainty =
        statistics.estimated_error > 0
            ? read.error * read.uncertainty / statistics.estimated_error
            : read.uncertainty;
    statistics.estimated_error_of = ErrorOf::gathered;
}

} // namespace

bool gathers(const SolveSettings& settings) {
    return !settings.points.output.empty() ||
           (settings.gather_pictures &&
            std::ranges::any_of(settings.outputs, is_picture, &Output::kind));
}

GatheredLight gather_light(const SolveSettings& settings, const Mesh& mesh, const Tracer& tracer,
                           const Solution& solution, std::span<const NamedPoint> points,
                           const Camera& camera, Monitor& monitor, Statistics& statistics) {
    GatheredLight light;
    if (!gathers(settings))
        return light;
    const Stopwatch watch;
    const Workers workers(settings.options.threads);
    light.cache = std::make_unique<LightCache>(mesh, tracer, solution);
    const double error = whole_error(settings);
    LearnOptions options{.error = share_of_read * error};
    if (settings.stop.rays)
        options.max_rays = *settings.stop.rays;
    ReadError read;
    double noise = 0;
    if (!points.empty()) {
        for (const NamedPoint& point : points)
            light.sensors.push_back(
                sensor_at(mesh, tracer, mesh.frame().to_local(point.position), point.normal));
        options.seed = hash_words({settings.options.seed, 3});
        read = light.cache->learn(parts_of(light.sensors), options, workers, monitor.interrupted);
        const PictureTime time(monitor.interrupted.own().wished);
        PointLightOptions of_points{.noise = share_of_noise * error,
                                    .read_error = std::isfinite(read.error) ? read.error : 0,
                                    .seed = hash_words({settings.options.seed, 2}),
                                    .give_up = [&time] { return time.is_over(); }};
        if (settings.gather)
            of_points.rays = PointSettings::rays_per_gather_ray * *settings.gather;
        light.points =
            light_at(light.sensors, mesh, tracer, light.cache->light(), of_points, workers);
        noise = light.points.noise;
        statistics.rays_gather += light.points.rays;
        statistics.rays_learn += read.rays;
    }
    if (settings.gather_pictures &&
        std::ranges::any_of(settings.outputs, is_picture, &Output::kind)) {
        const auto [width, height] = settings.view.size;
        const CameraRays rays(camera, mesh, double(width) / height);
        options.seed = hash_words({settings.options.seed, 5});
        const ReadError of_picture =
            light.cache->learn(picture_parts(mesh, tracer, rays, width, height,
                                             hash_words({settings.options.seed, 6}), workers),
                               options, workers, monitor.interrupted);
        if (points.empty() || of_picture.bound > read.bound)
            read = of_picture;
        statistics.rays_learn += of_picture.rays;
    }
    statistics.seconds_learn = watch.seconds();
    if (gives_gathered_light(settings))
        enter(statistics, read, noise);
    return light;
}

} // namespace hemilux
