#include "radiosity/light/final_gather/gather_paths.h"

#include "radiosity/light/cached_light/patch_light.h"
#include "radiosity/paper/rays/receivers.h"
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

/// The largest share of paths that go on where they end by chance alone: otherwise they would not
/// end in a closed room of reflectance 1.
constexpr double max_kept = .9;

} // namespace

GatherPaths::Traced GatherPaths::trace(PathRays rays, std::span<Vec3> found) const {
    Traced traced{};
    for (unsigned bounce = 0; !rays.random.empty(); ++bounce) {
        traced.rays += rays.shadow.trace(tracer_, [&](const LightAtPlace& sample, bool arrives) {
            if (arrives)
                found[sample.place] += sample.light;
        });
        traced.rays += rays.random.size();
        std::vector<std::uint32_t> receivers;
        find_receivers(rays.random, mesh_, tracer_, receivers);
        std::vector<Met> further;
        for (std::size_t k = 0; k < rays.random.size(); ++k) {
            if (receivers[k] == escaped || receivers[k] == absorbed)
                continue;
            const Met met = where_met(rays, k, receivers[k]);
            if (end_ray(rays.states[k], met, bounce, found))
                further.push_back(met);
        }
        // Rays on one patch follow each other, as emitters are weighed for it.
        std::ranges::stable_sort(further, {}, &Met::patch);
        PathRays next;
        for (const Met& met : further) {
            const PathRays::State& from = rays.states[met.ray];
            go_on(from, met, from.in_gather && is_near(met, bounce), next, found);
        }
        if (bounce == 0)
            traced.receivers = std::move(receivers);
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
    return find_ != Find::spread_however_near && bounce < max_bounces &&
           hemilux::is_near(met.distance, met.arriving.side);
}

bool GatherPaths::end_ray(const PathRays::State& ray, const Met& met, unsigned bounce,
                          std::span<Vec3> found) const {
    const bool reflects = met.here.reflectance != Vec3(0.0);
    const bool near = reflects && is_near(met, bounce);
    if (find_ == Find::light) {
        Vec3 light = near ? Vec3(0.0) : met.here.reflectance * met.arriving.value;
        if (ray.sees_emission || !emitters_.contains(met.patch))
            light += met.here.emission;
        found[ray.place] += ray.share * light;
        return near;
    }
    const Vec3 left_out = ray.sees_emission ? Vec3(0.0) : emitters_.emission(met.patch);
    if (!ray.in_gather)
        found[ray.place] += ray.share * (light_.of_patches().radiosity[met.patch] - left_out);
    return reflects && !ray.ends;
}

/// Adds one random ray of a path that goes on, and one to an emitter where such are taken.
void GatherPaths::go_on(const PathRays::State& from, const Met& met, bool in_gather, PathRays& next,
                        std::span<Vec3> found) const {
    const Patch& on = mesh_.patches()[met.patch];
    // Russian roulette (Arvo and Kirk 1990) keeps the paths in narrow gaps and bright rooms short.
    const Vec3& rho = met.here.reflectance;
    const double kept =
        std::min(std::max({rho.x, rho.y, rho.z}), find_ == Find::light ? 1 : max_kept);
    if (Rng(hash_words({from.seed, 2})).uniform() >= kept)
        return;
    const SurfacePoint at{met.point, on.normal, on.facet, met.patch};
    PathRays::State state = from;
    state.share = from.share * rho / kept;
    state.in_gather = in_gather;
    if (!in_gather)
        emitters_.weigh(at, next.weighed);
    add_rays(at, state, next);
    if (find_ == Find::light || in_gather)
        return;
    // This is the light of another point of the patch, which is as right on average, by the same
    // numbers.
    SurfacePoint other = at;
    Rng rng(hash_words({from.seed, 3}));
    const double u = rng.uniform(), v = rng.uniform();
    other.position = PolygonSampler(on.shape).sample({u, v});
    if (from.in_gather) // which reads the linear function there
        found[from.place] -= from.share / kept *
                             (radiosity_at(mesh_, light_.of_patches(), met.patch, at.position) -
                              radiosity_at(mesh_, light_.of_patches(), met.patch, other.position));
    state.share = -state.share;
    state.ends = true;
    add_rays(other, state, next);
}

void GatherPaths::add_rays(const SurfacePoint& at, const PathRays::State& state,
                           PathRays& next) const {
    Rng rng(state.seed);
    const bool by_shadow_ray = !state.in_gather && next.weighed.pays();
    const Ray further = at.ray(Frame::from_normal(at.normal).to_world(sample_cosine(rng)));
    PathRays::State then = state;
    then.seed = hash_words({state.seed, 1});
    then.sees_emission = !by_shadow_ray;
    next.add(further, then);
    if (by_shadow_ray)
        emitters_.add_ray(at, next.weighed, rng, state.share, state.place, next.shadow);
}

} // namespace hemilux
