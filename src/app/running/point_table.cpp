#include "app/running/point_table.h"

#include "app/rendering/view.h"
#include "io/files/error.h"
#include "parallel/workers.h"
#include "radiosity/paper/sampling/rng.h"

#include <algorithm>
#include <cmath>

namespace hemilux {

void check_distances(const std::string& path, std::span<const NamedPoint> points,
                     const Mesh& mesh) {
    constexpr double most = 1e6; // half the size of the scene is 1
    for (const NamedPoint& point : points) {
        const Vec3 local = glm::abs(mesh.frame().to_local(point.position));
        if (!(std::max({local.x, local.y, local.z}) <= most))
            throw InputError(path, point.line,
                             "expected a point near the scene, this one is more than half a "
                             "million times its size away");
    }
}

void write_points(const std::string& path, unsigned gather, const Results& results) {
    const auto& [mesh, tracer, solution, options, statistics, steps, points, warnings, monitor] =
        results;
    std::vector<Sensor> sensors;
    for (const NamedPoint& point : points)
        sensors.push_back(
            sensor_at(mesh, tracer, mesh.frame().to_local(point.position), point.normal));
    const PictureTime time(monitor.interrupted.own().wished);
    const std::vector<PointLight> lights =
        light_at(sensors, mesh, tracer, solution,
                 {.rays = PointSettings::rays_per_gather_ray * gather,
                  .seed = hash_words({options.seed, 2}),
                  .give_up = [&time] { return time.is_over(); }},
                 Workers(options.threads));
    if (lights.size() < sensors.size())
        throw Interrupted();
    write_points_table(path, mesh, points, sensors, lights);
}

} // namespace hemilux
