#include "radiosity/answers/lightmaps/smooth_point.h"

#include <algorithm>

namespace hemilux {
namespace {

/// The least height above a facet at which rays that leave it upwards do not meet it [local units,
/// of which a scene has about two].
constexpr double clear_of_facet = 1e-9;

/// Normals that differ less than this are those of a plane.
constexpr double bent = 1e-9;

} // namespace

SurfacePoint smooth_point(const SurfacePoint& flat, const SmoothTriangle& triangle, double u,
                          double v, const Tracer& tracer) {
    const std::array<double, 3> weight{1 - u - v, u, v};
    Vec3 normal(0.0), raised(0.0);
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3& n = triangle.normal[k];
        const double below = std::min(glm::dot(flat.position - triangle.corner[k], n), 0.0);
        normal += weight[k] * n;
        raised += weight[k] * (flat.position - below * n);
    }
    const double length = glm::length(normal);
    if (!(glm::dot(normal, flat.normal) > 0) || glm::length(normal / length - flat.normal) < bent)
        return flat;
    SurfacePoint point = flat;
    point.normal = normal / length;
    point.is_raised = true;
    point.position = flat.position + clear_of_facet * flat.normal;
    const Vec3 way = raised - flat.position;
    if (!(glm::dot(way, flat.normal) > clear_of_facet))
        return point;
    Ray ray = flat.ray(way);
    ray.t_max = 1;
    if (!tracer.occluded(ray))
        point.position = raised;
    return point;
}

} // namespace hemilux
