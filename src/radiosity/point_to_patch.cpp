#include "radiosity/point_to_patch.h"

#include "geometry/projected_polygon.h"
#include "radiosity/mesh.h"

namespace hemilux {

double point_to_patch(const Mesh& mesh, const Tracer& tracer, std::uint32_t from, std::uint32_t to,
                      const std::array<double, 4>& u, std::uint64_t& rays, bool visibility) {
    const Patch& source = mesh.patches()[from];
    const Patch& target = mesh.patches()[to];
    if (target.facet == source.facet)
        return 0;
    const Vec3 point = source.shape.sample({u[0], u[1]});
    const double height = glm::dot(target.normal, point - target.centre);
    if (!(height > 0)) // behind the target
        return 0;
    const ProjectedPolygon seen(point, Frame::from_normal(source.normal), target.shape);
    if (!(seen.factor() > 0))
        return 0;
    if (!visibility)
        return seen.factor();
    ++rays;
    Ray ray{point, seen.sample({u[2], u[3]})};
    ray.from = source.facet;
    // Short of the target by what rounding may do: a coplanar facet is not in front of it.
    ray.t_max = -height / glm::dot(target.normal, ray.direction) * (1 - 1e-10);
    return ray.t_max > 0 && !tracer.occluded(ray, target.facet) ? seen.factor() : 0;
}

} // namespace hemilux
