#include "radiosity/light/cached_light/walks.h"

#include "geometry/frame.h"
#include "radiosity/engine/rays/receivers.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>

namespace hemilux {
namespace {

/// The largest chance with which a walk goes on: otherwise it would not end in a closed room of
/// reflectance 1.
constexpr double max_kept = .99;

/// With more emitters, the points of a patch choose by the chances of the patch.
constexpr std::size_t max_emitters_by_point = 32;

/// Returns the point where a ray meets the plane of a patch.
Vec3 point_on(const Patch& patch, const Ray& ray) {
    const double along = glm::dot(ray.direction, patch.normal);
    const double way =
        along < 0 ? std::max(glm::dot(patch.centre - ray.origin, patch.normal) / along, 0.0) : 0;
    return ray.origin + way * ray.direction;
}

} // namespace

struct Walks::Work {
    std::vector<Vertex> vertices;
    std::vector<Ray> rays;
    std::vector<bool> sees_emission; ///< by ray
    std::vector<std::uint32_t> receivers;
    ShadowRays<LightAtPlace> shadow;
    WeighedEmitters weighed;
    std::uint64_t traced = 0;
};

/// Traces the rays of some vertices, and adds those that they lead to.
void Walks::trace(std::uint32_t begin, std::uint32_t end, Work& work,
                  std::span<WalkLight> found) const {
    work.rays.clear();
    work.sees_emission.clear();
    work.receivers.clear();
    const bool by_point = emitters_.count() <= max_emitters_by_point;
    for (std::uint32_t v = begin; v < end; ++v) {
        const Vertex& vertex = work.vertices[v];
        SurfacePoint at = vertex.at;
        if (by_point)
            at.patch = none;
        const bool is_as_before = v > begin && at.patch == none &&
                                  work.vertices[v - 1].at.position == at.position &&
                                  work.vertices[v - 1].at.normal == at.normal;
        if (!is_as_before)
            emitters_.weigh(at, work.weighed);
        const bool by_shadow_ray = work.weighed.pays();
        Rng rng(vertex.seed);
        if (by_shadow_ray)
            emitters_.add_ray(at, work.weighed, rng, Vec3(1.0), v, work.shadow);
        if (!points_.empty())
            points_.add_rays(at, 1, rng.uniform(), Vec3(1.0), v, work.shadow);
        const Frame frame = Frame::from_normal(at.normal);
        work.rays.push_back(at.ray(frame.to_world(cosine_direction(vertex.direction))));
        work.sees_emission.push_back(!by_shadow_ray);
    }
    work.traced += work.rays.size();
    work.traced += work.shadow.trace(tracer_, [&](const LightAtPlace& sample, double share) {
        if (!(share > 0))
            return;
        work.vertices[sample.place].found += share * sample.light;
        if (sample.place < found.size())
            found[sample.place].direct += share * sample.light;
    });
    find_receivers(work.rays, mesh_, tracer_, work.receivers);
    for (std::uint32_t v = begin; v < end; ++v) {
        const std::uint32_t patch = work.receivers[v - begin];
        if (patch == escaped || patch == absorbed)
            continue;
        const Patch& on = mesh_.patches()[patch];
        const Vec3 point = point_on(on, work.rays[v - begin]);
        const Colours here = colours_at(mesh_, on, point);
        const bool is_start = v < found.size();
        if (work.sees_emission[v - begin] || !emitters_.contains(patch)) {
            work.vertices[v].found += here.emission;
            if (is_start)
                found[v].direct += here.emission;
        }
        const Vec3& rho = here.reflectance;
        if (rho == Vec3(0.0))
            continue;
        const auto [irradiance, of_patch, near] = light_.irradiance(patch, point);
        work.vertices[v].found += rho * irradiance;
        if (is_start) {
            found[v].read += rho * irradiance;
            found[v].is_near = glm::distance(point, work.vertices[v].at.position) < near;
        }
        const std::uint64_t seed = hash_words({work.vertices[v].seed, 1});
        Rng rng(hash_words({work.vertices[v].seed, 2}));
        const double kept = is_start ? 1 : std::min(std::max({rho.x, rho.y, rho.z}), max_kept);
        if (rng.uniform() >= kept)
            continue;
        const double first = rng.uniform(), second = rng.uniform();
        work.vertices.push_back({.at = {point, on.normal, on.facet, patch},
                                 .before = v,
                                 .weight = rho / kept,
                                 .irradiance = irradiance,
                                 .of_patch = of_patch,
                                 .seed = seed,
                                 .direction = {first, second}});
    }
}

std::uint64_t Walks::take(std::span<const WalkStart> starts, std::span<WalkLight> found,
                          std::vector<IrradianceCells::Sample>& samples) const {
    Work work;
    for (const WalkStart& start : starts)
        work.vertices.push_back(
            {.at = start.at, .before = none, .seed = start.seed, .direction = start.direction});
    for (std::uint32_t begin = 0; begin < work.vertices.size();) {
        const auto end = static_cast<std::uint32_t>(work.vertices.size());
        // Vertices on one patch follow each other, as emitters are weighed for it.
        if (begin > 0)
            std::stable_sort(
                work.vertices.begin() + begin, work.vertices.end(),
                [](const Vertex& a, const Vertex& b) { return a.at.patch < b.at.patch; });
        trace(begin, end, work, found);
        begin = end;
    }
    for (std::size_t v = work.vertices.size(); v-- > starts.size();) {
        const Vertex& vertex = work.vertices[v];
        samples.push_back({vertex.at.patch, vertex.at.position, vertex.found - vertex.of_patch});
        const Vec3 lacks = vertex.weight * (vertex.found - vertex.irradiance);
        work.vertices[vertex.before].found += lacks;
        if (vertex.before < found.size())
            found[vertex.before].residual += lacks;
    }
    return work.traced;
}

} // namespace hemilux
