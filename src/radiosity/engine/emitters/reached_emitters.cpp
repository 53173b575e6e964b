#include "radiosity/engine/emitters/reached_emitters.h"

#include "radiosity/engine/emitters/small_emitters.h"
#include "radiosity/engine/factors/pairs/point_to_patch.h"
#include "radiosity/paper/sampling/rng.h"

#include <utility>

namespace hemilux {

ReachedEmitters::ReachedEmitters(const Mesh& mesh) : ReachedEmitters(mesh, small_emitters(mesh)) {}

ReachedEmitters::ReachedEmitters(const Mesh& mesh, std::span<const std::uint32_t> emitters)
    : mesh_(mesh), emission_(mesh.patches().size(), Vec3(0.0)),
      sides_(sides_of_emitters(mesh, emitters)), choice_(mesh, sides_) {
    for (const std::uint32_t i : emitters)
        emission_[i] = mesh.material(i).emission;
    for (const Patch& side : sides_) {
        const bool varies = mesh.emits_by_texture(side);
        emitters_.push_back({side, PolygonSampler(side.shape),
                             varies ? 0 : near_radii * radius_of(side),
                             mesh.material(side).emission, varies});
    }
}

void ReachedEmitters::weigh(const SurfacePoint& point, WeighedEmitters& weighed) const {
    if (emitters_.empty())
        return;
    if (point.patch == none)
        choice_.weigh(point.position, point.normal, weighed.cut);
    else if (point.patch != weighed.patch)
        choice_.weigh(point.patch, weighed.cut);
    weighed.patch = point.patch;
}

std::optional<ReachedEmitters::Aimed>
ReachedEmitters::aim(const EmitterChoice::Choice& chosen, const SurfacePoint& point, Vec2 u) const {
    const Emitter& emitter = emitters_[chosen.emitter];
    Ray ray{};
    const double factor = look_from(point.position, point.normal, point.from(), emitter.side,
                                    emitter.points, u, emitter.near, ray);
    if (!(factor > 0))
        return std::nullopt;
    const Vec3 emission =
        emitter.varies
            ? colours_at(mesh_, emitter.side, ray.origin + ray.t_max * ray.direction).emission
            : emitter.emission;
    return Aimed{ray, emitter.side.facet, factor / chosen.chance, emission};
}

void ReachedEmitters::add_rays(const SurfacePoint& point, const WeighedEmitters& weighed,
                               SobolBlocks<5>& numbers, std::uint32_t first, std::uint32_t count,
                               std::uint32_t place, ShadowRays<LightAtPlace>& rays) const {
    EmitterChoice::Choices choices;
    std::uint32_t chosen = none; // the block of the choices
    for (std::uint32_t k = first; k < first + count; ++k) {
        const auto u = numbers.at(k);
        if (std::exchange(chosen, k / samples_per_block) != k / samples_per_block)
            choice_.choose(weighed.cut, numbers.coordinate(4), choices);
        if (const auto aimed = aim(choices[k % samples_per_block], point, {u[2], u[3]}))
            rays.add(aimed->ray, aimed->target, {place, aimed->factor / count * aimed->emission});
    }
}

void ReachedEmitters::add_ray(const SurfacePoint& point, const WeighedEmitters& weighed, Rng& rng,
                              const Vec3& share, std::uint32_t place,
                              ShadowRays<LightAtPlace>& rays) const {
    EmitterChoice::Choices choices;
    std::array<double, samples_per_block> which{};
    which.fill(rng.uniform());
    choice_.choose(weighed.cut, which.data(), choices);
    const double u = rng.uniform(), v = rng.uniform();
    if (const auto aimed = aim(choices.front(), point, {u, v}))
        rays.add(aimed->ray, aimed->target, {place, aimed->factor * share * aimed->emission});
}

} // namespace hemilux
