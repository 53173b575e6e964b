#include "app/gathering/point_table.h"

#include "io/files/error.h"

#include <algorithm>
#include <cmath>
#include <tuple>

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

void write_points(const std::string& path, const Results& results) {
    const auto& [sensors, lights] =
        std::tie(results.gathered.sensors, results.gathered.points.lights);
    if (lights.size() < results.points.size())
        throw Interrupted();
    write_points_table(path, results.mesh, results.points, sensors, lights);
}

} // namespace hemilux
