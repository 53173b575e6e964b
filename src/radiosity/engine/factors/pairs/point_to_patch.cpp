#include "radiosity/engine/factors/pairs/point_to_patch.h"

#include "geometry/projected_polygon.h"
#include "radiosity/paper/scene/mesh.h"

#include <cmath>
#include <numbers>

namespace hemilux {
namespace {

/// A ray ends short of the target by what rounding may do: a coplanar facet is not in front of it.
constexpr double short_of_target = 1 - 1e-10;

} // namespace

double look_from(const Vec3& point, const Vec3& normal, std::uint32_t facet, const Patch& target,
                 const PolygonSampler& targets, Vec2 u, double near, Ray& ray) {
    if (target.facet == facet)
        return 0;
    ray.from = facet;
    ray.origin = point;
    const Vec3 off = ray.origin - target.centre;
    const double height = glm::dot(target.normal, off);
    if (!(height > 0)) // behind the target
        return 0;
    if (glm::dot(off, off) > near * near) {
        const Vec3 d = targets.sample(u) - ray.origin;
        const double rise = glm::dot(normal, d), r2 = glm::dot(d, d), r = std::sqrt(r2);
        ray.direction = d * (1 / r);
        ray.t_max = r * short_of_target;
        return rise > 0 ? rise * height * target.area / (std::numbers::pi * r2 * r2) : 0;
    }
    const ProjectedPolygon seen(ray.origin, Frame::from_normal(normal), target.shape);
    const double factor = seen.factor();
    if (!(factor > 0))
        return 0;
    ray.direction = seen.sample(u);
    ray.t_max = -height / glm::dot(target.normal, ray.direction) * short_of_target;
    return ray.t_max > 0 ? factor : 0;
}

double look_at(const Patch& source, const PolygonSampler& origins, const Patch& target,
               const PolygonSampler& targets, const std::array<double, 4>& u, double near,
               Ray& ray) {
    return look_from(origins.sample({u[0], u[1]}), source.normal, source.facet, target, targets,
                     {u[2], u[3]}, near, ray);
}

PairLook::PairLook(const Mesh& mesh, const Tracer& tracer, std::uint32_t from, std::uint32_t to,
                   double near, bool visibility)
    : tracer_(tracer), from_(mesh.patches()[from]), to_(mesh.patches()[to]), origins_(from_.shape),
      targets_(to_.shape), near_(near), visibility_(visibility) {}

double PairLook::factor(const std::array<double, 4>& u, std::uint64_t& rays) const {
    Ray ray{};
    const double f = look_at(from_, origins_, to_, targets_, u, near_, ray);
    if (!(f > 0) || !visibility_)
        return f;
    ++rays;
    return tracer_.occluded(ray, to_.facet) ? 0 : f * tracer_.passed(ray);
}

} // namespace hemilux
