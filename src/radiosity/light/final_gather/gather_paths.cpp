#include "radiosity/light/final_gather/gather_paths.h"

#include "radiosity/engine/rays/receivers.h"
#include "radiosity/light/cached_light/patch_light.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <utility>

namespace hemilux {
namespace {

/// The light that is reflected where it is too near to be read is gathered too, so many times at
/// the most.
constexpr unsigned max_bounces = 8;

} // namespace

std::uint64_t GatherPaths::trace(PathRays rays, std::span<Vec3> found) const {
    std::uint64_t traced = 0;
    for (unsigned bounce = 0; !rays.random.empty(); ++bounce) {
        traced += rays.shadow.trace(tracer_, [&](const LightAtPlace& sample, double share) {
            if (share > 0)
                found[sample.place] += share * sample.light;
        });
        traced += rays.random.size();
        std::vector<std::uint32_t> receivers;
        find_receivers(rays.random, mesh_, tracer_.of_facets(), receivers);
        std::vector<Met> further;
        for (std::size_t k = 0; k < rays.random.size(); ++k) {
            if (receivers[k] == escaped || receivers[k] == absorbed)
                continue;
            const Met met = where_met(rays, k, receivers[k]);
            rays.states[k].share *= tracer_.passed_up_to(rays.random[k], met.distance);
            if (end_ray(rays.states[k], met, bounce, found))
                further.push_back(met);
        }
        // Rays on one patch follow each other, as emitters are weighed for it.
        std::ranges::stable_sort(further, {}, &Met::patch);
        PathRays next;
        for (const Met& met : further) {
            const PathRays::State& from = rays.states[met.ray];
            go_on(from, met, next);
        }
        rays = std::move(next);
    }
    return traced;
}

GatherPaths::Met GatherPaths::where_met(const PathRays& rays, std::size_t k,
                                        std::uint32_t patch) const {
    const Patch& on = mesh_.patches()[patch];
    const Ray& ray = rays.random[k];
    const double along = glm::dot(ray.direction, on.normal);
    const double way =
        along < 0 ? std::max(glm::dot(on.centre - ray.origin, on.normal) / along, 0.0) : 0;
    const Vec3 point = ray.origin + way * ray.direction;
    return {k, patch, point, way, colours_at(mesh_, on, point), light_.irradiance(patch, point)};
}

bool GatherPaths::is_near(const Met& met, unsigned bounce) const {
    return bounce < max_bounces && met.distance < met.arriving.near;
}

bool GatherPaths::end_ray(const PathRays::State& ray, const Met& met, unsigned bounce,
                          std::span<Vec3> found) const {
    const bool near = met.here.reflectance != Vec3(0.0) && is_near(met, bounce);
    Vec3 light = near ? Vec3(0.0) : met.here.reflectance * met.arriving.value;
    if (!ray.only_reflected && (ray.sees_emission || !emitters_.contains(met.patch)))
        light += met.here.emission;
    found[ray.place] += ray.share * light;
    return near;
}

/// Adds one random ray of a path that goes on, and one to an emitter of each kind where such are
/// taken.
void GatherPaths::go_on(const PathRays::State& from, const Met& met, PathRays& next) const {
    const Patch& on = mesh_.patches()[met.patch];
    PathRays::State state = from;
    state.share = from.share * met.here.reflectance;
    begin_at({met.point, on.normal, on.facet, met.patch}, state, next);
}

void GatherPaths::add_rays(const SurfacePoint& at, const PathRays::State& state,
                           PathRays& next) const {
    Rng rng(state.seed);
    const bool by_shadow_ray = next.weighed.pays();
    const Ray further = at.ray(Frame::from_normal(at.normal).to_world(sample_cosine(rng)));
    PathRays::State then = state;
    then.seed = hash_words({state.seed, 1});
    then.sees_emission = !by_shadow_ray;
    then.only_reflected = false;
    next.add(further, then);
    if (by_shadow_ray)
        emitters_.add_ray(at, next.weighed, rng, state.share, state.place, next.shadow);
    if (!points_.empty())
        points_.add_rays(at, 1, rng.uniform(), state.share, state.place, next.shadow);
}

} // namespace hemilux
