#include "radiosity/light/sides/light_paths.h"

#include "geometry/frame.h"
#include "radiosity/engine/rays/point_emitter.h"
#include "radiosity/paper/rays/shot.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace hemilux {
namespace {

/// The distance from a plane at which rays begin [local units], in a frame of a size of about 1. It
/// is more than the layers of one place are apart, and less than an emitter is from its ceiling.
constexpr double off_the_plane = 0x1p-23;

Ray diffuse_ray_at(const Mesh& mesh, FacetSide side, const Vec3& point, Rng& rng) {
    const Vec3 normal = mesh.whole_side(side.facet, side.back).normal;
    const Vec3 direction = Frame::from_normal(normal).to_world(sample_cosine(rng));
    return {.origin = point, .direction = direction, .t_min = off_the_plane, .from = side.facet};
}

Vec3 random_point(const Mesh& mesh, std::uint32_t facet, Rng& rng) {
    const double v = rng.uniform(), u = rng.uniform();
    return mesh.shape_of(facet).sample({u, v});
}

/// Follows a path from surface to surface, for as long as arrive(side) says so; `side` is empty
/// where the path leaves the scene.
template <class Arrive>
void follow(const Mesh& mesh, const Tracer& tracer, Ray ray, Rng& rng, const Arrive& arrive) {
    for (;;) {
        const std::optional<Hit> hit = tracer.closest(ray);
        const auto side = hit ? std::optional(FacetSide{hit->facet, !hit->front}) : std::nullopt;
        if (!arrive(side) || !side)
            return;
        ray = diffuse_ray_at(mesh, *side, ray.origin + hit->t * ray.direction, rng);
    }
}

template <class Emit>
void for_each_path(const std::vector<double>& weights, std::uint32_t count, const Emit& emit) {
    const std::vector<std::uint32_t> shares = shares_of(weights, count);
    for (std::uint32_t f = 0; f < shares.size(); ++f)
        for (std::uint32_t k = 0; k < shares[f]; ++k)
            emit(f, k);
}

/// Returns the power of each facet, then that of each light without extent.
std::vector<double> powers_of(const Mesh& mesh) {
    std::vector<double> power(mesh.scene().facets.size());
    for (std::uint32_t f = 0; f < power.size(); ++f)
        power[f] = power_of(mesh, f);
    const double scale = mesh.frame().scale;
    for (const PointEmitter& emitter : point_emitters_of(mesh.scene())) {
        const Vec3& i = emitter.intensity;
        const double sum = power_per_intensity(emitter) * scale * scale * (i.r + i.g + i.b);
        power.push_back(std::isfinite(sum) ? sum : 0);
    }
    return power;
}

/// Returns the light without extent of this number among the powers; nullptr for a facet.
const PointEmitter* point_emitter_at(const Mesh& mesh, std::uint32_t number) {
    const std::size_t facets = mesh.scene().facets.size();
    return number < facets ? nullptr : &point_emitters_of(mesh.scene())[number - facets];
}

/// Returns a ray from a light without extent, by its intensity.
Ray ray_from(const Mesh& mesh, const PointEmitter& emitter, Rng& rng) {
    constexpr int max_tries = 1000;
    Vec3 direction = emitter.axis;
    for (int i = 0; i < max_tries; ++i) {
        direction = random_direction(emitter, {rng.uniform(), rng.uniform()});
        if (rng.uniform() * max_relative_intensity(emitter) <
            relative_intensity(emitter, direction))
            break;
    }
    return {.origin = mesh.frame().to_local(emitter.position),
            .direction = direction,
            .t_min = off_the_plane};
}

} // namespace

Ray diffuse_ray(const Mesh& mesh, FacetSide side, Rng& rng) {
    const Vec3 point = random_point(mesh, side.facet, rng);
    return diffuse_ray_at(mesh, side, point, rng);
}

Targets::Targets(const Mesh& mesh) : mesh_(mesh) {
    double sum = 0;
    for (std::uint32_t f = 0; f < mesh.scene().facets.size(); ++f)
        area_sums_.push_back(sum += power_of(mesh, f) > 0 ? 0 : mesh.shape_of(f).area());
}

std::optional<Ray> Targets::ray_from(FacetSide side, Rng& rng) const {
    const auto place = std::ranges::upper_bound(area_sums_, rng.uniform() * area_sums_.back());
    const auto facet =
        static_cast<std::uint32_t>(std::min(place, area_sums_.end() - 1) - area_sums_.begin());
    const Vec3 from = random_point(mesh_, side.facet, rng);
    const Vec3 way = random_point(mesh_, facet, rng) - from;
    if (!(glm::dot(way, mesh_.whole_side(side.facet, side.back).normal) > off_the_plane))
        return std::nullopt;
    return Ray{.origin = from,
               .direction = glm::normalize(way),
               .t_min = off_the_plane,
               .from = side.facet};
}

double power_of(const Mesh& mesh, std::uint32_t facet) {
    const Material& material = mesh.scene().materials[mesh.scene().facets[facet].material];
    const Vec3& e = material.emission;
    const double sum = e.r + e.g + e.b;
    if (material.is_far || !(sum > 0) || !std::isfinite(sum))
        return 0;
    return sum * mesh.shape_of(facet).area();
}

std::vector<std::uint32_t> shares_of(const std::vector<double>& weights, std::uint32_t count) {
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::vector<std::uint32_t> shares(weights.size(), 0);
    if (!(sum > 0) || !std::isfinite(sum))
        return shares;
    double before = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const double after = before + weights[i] / sum * count;
        shares[i] = static_cast<std::uint32_t>(std::floor(after + 0.5) - std::floor(before + 0.5));
        before = after;
    }
    return shares;
}

std::vector<SideLight> light_on_sides(const Mesh& mesh, const Tracer& tracer,
                                      const Targets& targets,
                                      const std::vector<bool>& shines_back) {
    // Most files are in order: their backs stay dark, and the first paths show it.
    constexpr std::uint32_t first_paths = 1u << 11, more_paths = 3u << 11;
    constexpr double reflected = 0.5;
    Rng rng(1);
    std::vector<SideLight> light(shines_back.size(), SideLight{});
    const auto arrive = [&](std::optional<FacetSide> side) {
        if (side)
            light[side->facet][side->back] += 1;
        return rng.uniform() < reflected;
    };
    // Every other path starts towards a target.
    const auto emit = [&](std::uint32_t f, std::uint32_t k) {
        if (const PointEmitter* const emitter = point_emitter_at(mesh, f)) {
            follow(mesh, tracer, ray_from(mesh, *emitter, rng), rng, arrive);
            return;
        }
        const FacetSide side{f, shines_back[f]};
        const std::optional<Ray> aimed = k % 2 == 1 ? targets.ray_from(side, rng) : std::nullopt;
        follow(mesh, tracer, aimed ? *aimed : diffuse_ray(mesh, side, rng), rng, arrive);
    };
    const std::vector<double> power = powers_of(mesh);
    for_each_path(power, first_paths, emit);
    if (std::ranges::any_of(light, [](const SideLight& side) { return side[1] > 0; }))
        for_each_path(power, more_paths, emit);
    return light;
}

LightShares find_light_shares(const Mesh& mesh, const Tracer& tracer) {
    constexpr std::uint32_t paths = 1024;
    constexpr double longest = 0.99; // of the chances to go on
    const auto material = [&](std::uint32_t f) -> const Material& {
        return mesh.scene().materials[mesh.scene().facets[f].material];
    };
    LightShares sum;
    Rng rng(2);
    for_each_path(powers_of(mesh), paths, [&](std::uint32_t f, std::uint32_t k) {
        const PointEmitter* const emitter = point_emitter_at(mesh, f);
        const Vec3& e = emitter ? emitter->intensity : material(f).emission;
        Vec3 weight = e / (e.r + e.g + e.b) / double{paths};
        // The path goes on until the light falls on a back, leaves, or is absorbed by chance.
        const auto arrive = [&](std::optional<FacetSide> side) {
            if (!side || (side->back && !mesh.has_back(side->facet))) {
                (side ? sum.backs : sum.escaped) += weight.r + weight.g + weight.b;
                return false;
            }
            const Vec3& reflectance = material(side->facet).reflectance;
            const double survival =
                std::min(std::max({reflectance.r, reflectance.g, reflectance.b}), longest);
            weight *= reflectance / survival;
            return rng.uniform() < survival;
        };
        const Ray first = emitter ? ray_from(mesh, *emitter, rng)
                                  : diffuse_ray(mesh, {f, mesh.has_back(f) && k % 2 == 1}, rng);
        follow(mesh, tracer, first, rng, arrive);
    });
    return sum;
}

} // namespace hemilux
