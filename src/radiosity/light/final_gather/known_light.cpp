#include "radiosity/light/final_gather/known_light.h"

#include "radiosity/light/final_gather/final_gather.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solution/solution.h"
#include "radiosity/paper/solving/stop_flag.h"

#include <cmath>
#include <limits>

namespace hemilux {

KnownLight::KnownLight(const Mesh& mesh, const Tracer& tracer, std::span<const Vec3> accurate,
                       std::size_t points, std::uint64_t seed, const Workers& workers,
                       const StopFlag& interrupted)
    : mesh_(mesh) {
    FinalGather gather(mesh, tracer, accurate);
    const PointsOverSurface surface(mesh,
                                    mixed_density(mesh, {}, {reflected_squares(mesh, accurate)}));
    const GatheredAtPoints found =
        gather_over(surface, gather, points, 2, seed, workers, interrupted);
    if (interrupted)
        return;
    for (std::size_t k = 0; k < found.points.size(); ++k) {
        const std::uint32_t patch = found.points[k].patch;
        const Vec3& reflectance = mesh.material(patch).reflectance;
        points_.push_back({patch, found.points[k].area, reflectance * found.irradiance[2 * k],
                           reflectance * found.irradiance[2 * k + 1]});
    }
}

double KnownLight::error(std::span<const Vec3> radiosity) const {
    double squares = 0, size = 0;
    for (const Point& point : points_) {
        const Vec3 value = radiosity[point.patch] - mesh_.material(point.patch).emission;
        squares += point.area * glm::dot(point.reflected1 - value, point.reflected2 - value);
        size += point.area * glm::dot(point.reflected1, point.reflected2);
    }
    return squares > 0 && size > 0 ? std::sqrt(squares / size)
                                   : std::numeric_limits<double>::quiet_NaN();
}

} // namespace hemilux
