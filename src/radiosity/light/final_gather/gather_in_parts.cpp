#include "radiosity/light/final_gather/gather_in_parts.h"

#include "radiosity/engine/rays/receivers.h"
#include "radiosity/light/cached_light/patch_light.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

namespace hemilux {
namespace {

constexpr std::size_t rays_traced_together = 4096;

/// The number of successive points on one facet that aim rays by the chances of the first.
constexpr std::uint32_t shared_aim = 16;

/// Points on one facet whose samples belong to one block of so many use the same chances of
/// emitters: they lie near each other.
constexpr std::uint32_t shared_weights = 64;

} // namespace

std::vector<EmitterLight> GatherInParts::direct(std::span<const SurfacePoint> points,
                                                std::span<const GatherSamples> samples,
                                                Shadows shadows) const {
    std::vector<EmitterLight> found(points.size());
    if (only_reflected_)
        return found;
    WeighedEmitters weighed;
    ShadowRays<LightAtPlace> rays;
    const auto trace = [&] {
        traced_ += rays.size();
        rays.trace(tracer_, [&](const LightAtPlace& sample, double share) {
            if (share > 0)
                found[sample.place].arriving += share * sample.light;
        });
    };
    for (std::uint32_t k = 0; k < points.size(); ++k) {
        const GatherSamples& own = samples[k];
        const bool alike = k > 0 && points[k].facet == points[k - 1].facet &&
                           points[k].normal == points[k - 1].normal &&
                           own.first / shared_weights == samples[k - 1].first / shared_weights;
        if (!alike)
            emitters_.weigh(points[k], weighed);
        if (weighed.cut.dark())
            continue;
        const std::size_t before = rays.size();
        SobolBlocks<5> numbers(own.seed);
        emitters_.add_rays(points[k], weighed, numbers, own.first, own.count, k, rays);
        double by_nearness = 0;
        for (std::size_t ray = before; ray < rays.size(); ++ray) {
            const Vec3& light = rays.sample(ray).light;
            found[k].unshadowed += light;
            by_nearness += mean_of_channels(light) / rays.ray(ray).t_max;
        }
        if (by_nearness > 0)
            found[k].nearness = by_nearness / mean_of_channels(found[k].unshadowed);
        if (shadows == Shadows::left_out)
            rays.clear();
        else if (rays.size() >= rays_traced_together)
            trace();
    }
    trace();
    return found;
}

std::vector<Vec3> GatherInParts::from_points(std::span<const SurfacePoint> points,
                                             std::span<const GatherSamples> samples) const {
    std::vector<Vec3> found(points.size(), Vec3(0.0));
    const PointEmitters& emitters = paths_.points();
    if (only_reflected_ || emitters.empty())
        return found;
    ShadowRays<LightAtPlace> rays;
    const auto add = [&](const LightAtPlace& sample, double share) {
        if (share > 0)
            found[sample.place] += share * sample.light;
    };
    const auto trace = [&] {
        traced_ += rays.size();
        rays.trace(tracer_, add);
    };
    for (std::uint32_t k = 0; k < points.size(); ++k) {
        emitters.add_rays(points[k], PointEmitters::max_rays_of_point,
                          Rng(hash_words({samples[k].seed, samples[k].first})).uniform(), Vec3(1.0),
                          k, rays);
        if (rays.size() >= rays_traced_together)
            trace();
    }
    trace();
    return found;
}

/// Adds what each ray meets; what is near goes on as a path. A ray that was aimed counts only where
/// it meets its patch. Then, and where a random ray meets the same patch, it counts by the
/// densities of both (balance heuristic: Veach and Guibas 1995).
void GatherInParts::read_patches(std::span<const SurfacePoint> points, const Rays& rays,
                                 std::span<IndirectLight> found) const {
    const Tracer& facets = tracer_.of_facets();
    std::array<FacetHit, rays_at_a_time> hits;
    PathRays near;
    traced_ += rays.rays.size();
    for (std::size_t begin = 0; begin < rays.rays.size(); begin += hits.size()) {
        const std::size_t n = std::min(hits.size(), rays.rays.size() - begin);
        const auto some = std::span(rays.rays).subspan(begin, n);
        facets.closest_stream(some, std::span(hits).first(n));
        for (std::size_t k = 0; k < n; ++k) {
            if (hits[k].facet == none)
                continue;
            const Ray& ray = some[k];
            const Hit hit = facets.locate(ray, hits[k].facet);
            const std::uint32_t patch = mesh_.patch_at(hit);
            const auto& [place, at_random, target] = rays.samples[begin + k];
            if (target != none && patch != target)
                continue;
            double rays_there = at_random;
            if (rays.aimed > 0 && patch != none)
                rays_there += rays.aimed * std::numbers::pi /
                              glm::dot(ray.direction, points[place].normal) *
                              bright_.density(rays.aim, patch, hit.t, ray.direction);
            IndirectLight& light = found[place];
            constexpr double touching = 1e-6;
            light.nearness += 1 / (rays_there * std::max(hit.t, touching));
            if (patch == none)
                continue;
            const Vec3 point = ray.origin + hit.t * ray.direction;
            const Patch& on = mesh_.patches()[patch];
            const Colours here = colours_at(mesh_, on, point);
            const SurfaceLight::Irradiance arriving = light_.irradiance(patch, point);
            const double passed = tracer_.passed_up_to(ray, hit.t);
            Vec3 sent =
                only_reflected_ || emitters_.contains(patch) ? Vec3(0.0) : passed * here.emission;
            if (hit.t < arriving.near) {
                light.irradiance += sent / rays_there;
                paths_.begin_at({point, on.normal, on.facet, patch},
                                {.seed = hash_words({rays.seed, begin + k}),
                                 .place = place,
                                 .share = passed * here.reflectance / rays_there},
                                near);
                sent += passed * here.reflectance * arriving.value;
            } else {
                sent += passed * here.reflectance * arriving.value;
                light.irradiance += sent / rays_there;
            }
            const double square = mean_of_channels(sent * sent);
            light.squares += square;
            if (bright_.contains(patch))
                light.bright_squares += square;
        }
    }
    std::vector<Vec3> reflected_near(points.size(), Vec3(0.0));
    paths_.trace(std::move(near), reflected_near);
    for (std::size_t k = 0; k < points.size(); ++k)
        found[k].irradiance += reflected_near[k];
}

std::vector<IndirectLight> GatherInParts::indirect(std::span<const SurfacePoint> points,
                                                   std::span<const GatherSamples> samples) const {
    std::vector<IndirectLight> found(points.size());
    Rays rays;
    std::uint32_t aims = 0; // the point whose chances are used
    for (std::uint32_t k = 0; k < points.size(); ++k) {
        const SurfacePoint& point = points[k];
        const auto& [seed, first, count, partly_aimed] = samples[k];
        const bool alike =
            partly_aimed == samples[aims].partly_aimed &&
            (!partly_aimed || (k > 0 && k - aims < shared_aim &&
                               point.facet == points[aims].facet && count == samples[aims].count));
        if (!alike || rays.rays.size() >= rays_traced_together) {
            read_patches(points, rays, found);
            rays.rays.clear();
            rays.samples.clear();
            rays.seed = hash_words({seed, first});
        }
        if (!alike) {
            aims = k;
            rays.aimed = 0;
            if (partly_aimed) {
                bright_.aim(point, rays.aim);
                rays.aimed = rays.aim.sees_any() ? count / 2 : 0;
            }
        }
        const unsigned at_random = count - rays.aimed;
        const auto add = [&](const Vec3& direction, std::uint32_t target) {
            rays.rays.push_back(point.ray(direction));
            rays.samples.push_back({k, at_random, target});
        };
        const Frame frame = Frame::from_normal(point.normal);
        const std::uint32_t place = first / count;
        SobolBlocks<5> numbers(seed);
        for (std::uint32_t next = 0; next < at_random; ++next) {
            const auto u = numbers.at(place * at_random + next);
            add(frame.to_world(cosine_direction({u[0], u[1]})), none);
        }
        for (std::uint32_t next = 0; next < rays.aimed; ++next) {
            const auto u = numbers.at(place * rays.aimed + next);
            const auto [direction, patch] = bright_.draw(point, rays.aim, {u[4], u[2], u[3]});
            if (glm::dot(direction, point.normal) > 0)
                add(direction, patch);
        }
    }
    read_patches(points, rays, found);
    return found;
}

} // namespace hemilux
