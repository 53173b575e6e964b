#include "app/gathering/point_table.h"

#include "io/files/error.h"

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

void write_points(const std::string& path, const Mesh& mesh, std::span<const NamedPoint> points,
                  const GatheredLight& gathered, const Workers& workers,
                  const csv::MoreColumns& more) {
    if (!gathered.points) // nothing was gathered
        throw Interrupted();
    const GatheredPoints& light = gathered.points->value;
    write_points_table(path, mesh, points, light.sensors, light.found.lights, workers, more);
}

} // namespace hemilux
