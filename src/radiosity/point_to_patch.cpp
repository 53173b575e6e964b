#include "radiosity/point_to_patch.h"

#include "geometry/polygon_sampler.h"
#include "geometry/projected_polygon.h"
#include "radiosity/mesh.h"

#include <cmath>
#include <numbers>

namespace hemilux {
namespace {

/// The factor that `point` gives to all of the target as seen along `direction`, which becomes
/// unit.
double factor_to_point(const Patch& source, const Patch& target, Vec3& direction) {
    const double r2 = glm::dot(direction, direction);
    direction /= std::sqrt(r2);
    const double cosines = glm::dot(source.normal, direction) * -glm::dot(target.normal, direction);
    return glm::dot(source.normal, direction) > 0 ? cosines * target.area / (std::numbers::pi * r2)
                                                  : 0;
}

} // namespace

Sightline look_at(const Patch& source, const PolygonSampler& origins, const Patch& target,
                  const PolygonSampler& targets, const std::array<double, 4>& u, bool distant) {
    if (target.facet == source.facet)
        return {};
    Sightline sight;
    sight.ray.from = source.facet;
    sight.ray.origin = origins.sample({u[0], u[1]});
    const double height = glm::dot(target.normal, sight.ray.origin - target.centre);
    if (!(height > 0)) // behind the target
        return {};
    if (distant) {
        sight.ray.direction = targets.sample({u[2], u[3]}) - sight.ray.origin;
        sight.factor = factor_to_point(source, target, sight.ray.direction);
    } else {
        const ProjectedPolygon seen(sight.ray.origin, Frame::from_normal(source.normal),
                                    target.shape);
        sight.factor = seen.factor();
        if (sight.factor > 0)
            sight.ray.direction = seen.sample({u[2], u[3]});
    }
    if (!(sight.factor > 0))
        return {};
    // Short of the target by what rounding may do: a coplanar facet is not in front of it.
    sight.ray.t_max = -height / glm::dot(target.normal, sight.ray.direction) * (1 - 1e-10);
    if (!(sight.ray.t_max > 0))
        return {};
    return sight;
}

double point_to_patch(const Mesh& mesh, const Tracer& tracer, std::uint32_t from, std::uint32_t to,
                      const std::array<double, 4>& u, std::uint64_t& rays, bool visibility) {
    const Patch &source = mesh.patches()[from], &target = mesh.patches()[to];
    const Sightline sight = look_at(source, PolygonSampler(source.shape), target,
                                    PolygonSampler(target.shape), u, false);
    if (!(sight.factor > 0) || !visibility)
        return sight.factor;
    ++rays;
    return tracer.occluded(sight.ray, target.facet) ? 0 : sight.factor;
}

} // namespace hemilux
