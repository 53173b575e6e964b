#include "bvh/brute_force.h"

namespace hemilux {

std::optional<Hit> BruteForce::closest(const Ray& ray) const {
    const ShearedRay sheared(ray.origin, ray.direction);
    Hit best{none, ray.t_max, 0, 0, false, false}, hit{};
    for (std::uint32_t f = 0; f < soup_.facets.size(); ++f)
        if (f != ray.from &&
            hit_facet<EdgeRule::inclusive>(soup_.vertices, soup_.facets[f], sheared, ray.t_min,
                                           best.t, hit) &&
            comes_before(hit.t, f, best)) {
            best = hit;
            best.facet = f;
        }
    return best.facet == none ? std::nullopt : std::optional(best);
}

bool BruteForce::occluded(const Ray& ray, std::uint32_t target) const {
    const ShearedRay sheared(ray.origin, ray.direction);
    Hit hit{};
    for (std::uint32_t f = 0; f < soup_.facets.size(); ++f)
        if (f != ray.from && f != target &&
            hit_facet<EdgeRule::inclusive>(soup_.vertices, soup_.facets[f], sheared, ray.t_min,
                                           ray.t_max, hit))
            return true;
    return false;
}

std::uint32_t BruteForce::count(const Ray& ray) const {
    const ShearedRay sheared(ray.origin, ray.direction);
    Hit hit{};
    std::uint32_t pierced = 0;
    for (std::uint32_t f = 0; f < soup_.facets.size(); ++f)
        pierced +=
            f != ray.from && hit_facet<EdgeRule::half_open>(soup_.vertices, soup_.facets[f],
                                                            sheared, ray.t_min, ray.t_max, hit);
    return pierced;
}

} // namespace hemilux
