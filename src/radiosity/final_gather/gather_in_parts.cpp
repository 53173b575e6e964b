#include "radiosity/final_gather/gather_in_parts.h"

#include "radiosity/rays/receivers.h"
#include "radiosity/rays/shot.h"
#include "radiosity/scene/mesh.h"

#include <algorithm>
#include <array>

namespace hemilux {
namespace {

constexpr std::size_t rays_traced_together = 4096;

/// Points on one facet whose samples are of one block of so many use the same chances of emitters:
/// they lie near each other.
constexpr std::uint32_t shared_weights = 64;

} // namespace

std::vector<DirectLight> GatherInParts::direct(std::span<const SurfacePoint> points,
                                               std::span<const GatherSamples> samples,
                                               Shadows shadows) const {
    std::vector<DirectLight> found(points.size());
    WeighedEmitters weighed;
    ShadowRays rays;
    const auto trace = [&] {
        rays.trace(tracer_,
                   [&](std::uint32_t place, const Vec3& light) { found[place].arriving += light; });
    };
    for (std::uint32_t k = 0; k < points.size(); ++k) {
        const auto& [seed, first, count] = samples[k];
        const bool alike = k > 0 && points[k].facet == points[k - 1].facet &&
                           first / shared_weights == samples[k - 1].first / shared_weights;
        if (!alike)
            emitters_.weigh(points[k], weighed);
        if (weighed.cut.dark())
            continue;
        const std::size_t before = rays.samples.size();
        SobolBlocks<5> numbers(seed);
        emitters_.add_rays(points[k], weighed, numbers, first, count, k, rays);
        double by_nearness = 0;
        for (std::size_t ray = before; ray < rays.samples.size(); ++ray) {
            const Vec3& light = rays.samples[ray].light;
            found[k].unshadowed += light;
            by_nearness += mean_of_channels(light) / rays.rays[ray].t_max;
        }
        if (by_nearness > 0)
            found[k].nearness = by_nearness / mean_of_channels(found[k].unshadowed);
        if (shadows == Shadows::left_out)
            rays.clear();
        else if (rays.rays.size() >= rays_traced_together)
            trace();
    }
    trace();
    return found;
}

/// Adds what each ray meets.
void GatherInParts::read_patches(std::span<const Ray> rays, std::span<const Sample> samples,
                                 std::span<IndirectLight> found) const {
    std::array<FacetHit, rays_at_a_time> hits;
    for (std::size_t begin = 0; begin < rays.size(); begin += hits.size()) {
        const std::size_t n = std::min(hits.size(), rays.size() - begin);
        const auto some = rays.subspan(begin, n);
        tracer_.closest_stream(some, std::span(hits).first(n));
        for (std::size_t k = 0; k < n; ++k) {
            if (hits[k].facet == none)
                continue;
            const Hit hit = tracer_.locate(some[k], hits[k].facet);
            const auto& [place, share] = samples[begin + k];
            constexpr double touching = 1e-6;
            found[place].nearness += share / std::max(hit.t, touching);
            if (const std::uint32_t patch = mesh_.patch_at(hit); patch != none)
                found[place].irradiance +=
                    share * (radiosity_at(mesh_, light_, patch,
                                          some[k].origin + hit.t * some[k].direction) -
                             emitters_.emission(patch));
        }
    }
}

std::vector<IndirectLight> GatherInParts::indirect(std::span<const SurfacePoint> points,
                                                   std::span<const GatherSamples> samples) const {
    std::vector<IndirectLight> found(points.size());
    std::vector<Ray> rays;
    std::vector<Sample> of_rays;
    for (std::uint32_t k = 0; k < points.size(); ++k) {
        const SurfacePoint& point = points[k];
        const auto& [seed, first, count] = samples[k];
        const Frame frame = Frame::from_normal(point.normal);
        SobolBlocks<5> numbers(seed);
        for (std::uint32_t next = first; next < first + count; ++next) {
            const auto u = numbers.at(next);
            Ray ray{point.position, frame.to_world(cosine_direction({u[0], u[1]}))};
            ray.from = point.facet;
            rays.push_back(ray);
            of_rays.push_back({k, 1.0 / count});
        }
        if (rays.size() >= rays_traced_together || k + 1 == points.size()) {
            read_patches(rays, of_rays, found);
            rays.clear();
            of_rays.clear();
        }
    }
    return found;
}

} // namespace hemilux
