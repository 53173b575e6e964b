#include "radiosity/light/cached_light/page/how_wrong.h"

#include "geometry/frame.h"
#include "geometry/numeric.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <array>
#include <optional>

namespace hemilux {
namespace {

struct Page {
    const Mesh& mesh;
    const Tracer& tracer;
    const PatchLight& light;
    Rng rng;

    /// The residuals of the samples that landed on a patch: one cell for each.
    struct Cell {
        Vec3 sum{0.0};
        double count = 0;
    };
    std::vector<Cell> known, pending; ///< by patch: what is read, and what joins after the round

    /// h: the irradiance of a patch, with the mean residual of its cell, shrunk by the count alone.
    [[nodiscard]] Vec3 read(std::uint32_t patch) const {
        constexpr double prior = 16;
        const auto& [sum, count] = known[patch];
        return of_patch(patch) + sum / (count + prior);
    }
    [[nodiscard]] Vec3 of_patch(std::uint32_t patch) const {
        const Material& material = mesh.material(patch);
        return ratio_or_zero(light.radiosity[patch] - material.emission, material.reflectance);
    }

    /// A cosine-distributed ray.
    std::optional<SurfacePoint> ray_from(const SurfacePoint& x) {
        const Ray ray = x.ray(Frame::from_normal(x.normal).to_world(sample_cosine(rng)));
        const std::optional<Hit> hit = tracer.closest(ray);
        const std::uint32_t patch = hit ? mesh.patch_at(*hit) : none;
        if (patch == none)
            return std::nullopt;
        const Patch& on = mesh.patches()[patch];
        return SurfacePoint{ray.origin + hit->t * ray.direction, on.normal, on.facet, patch};
    }

    /// What a gather reads along a ray: what is emitted where it ends, and what is reflected there.
    [[nodiscard]] Vec3 sent(const SurfacePoint& y) const {
        const Material& material = mesh.material(y.patch);
        return material.emission + material.reflectance * read(y.patch);
    }

    /// i(y) - h(y): a sample of the irradiance of y, less what is read there. The walk goes on with
    /// the largest reflectance as its chance, so its weight never grows.
    Vec3 residual(const SurfacePoint& y) {
        Vec3 irradiance(0.0);
        if (const auto z = ray_from(y)) {
            const Vec3& rho = mesh.material(z->patch).reflectance;
            const double s = std::min(std::max({rho.x, rho.y, rho.z}), .99);
            irradiance = sent(*z);
            if (rng.uniform() < s)
                irradiance += rho / s * residual(*z);
        }
        pending[y.patch].sum += irradiance - of_patch(y.patch);
        ++pending[y.patch].count;
        return irradiance - read(y.patch);
    }

    /// What gathers at x lack, from one group of walks.
    Vec3 lacking(const SurfacePoint& x, std::size_t walks) {
        Vec3 sum(0.0);
        for (std::size_t k = 0; k < walks; ++k)
            if (const auto y = ray_from(x); y && mesh.material(y->patch).reflectance != Vec3(0.0))
                sum += mesh.material(y->patch).reflectance * residual(*y);
        return sum / double(walks);
    }

    Vec3 gather(const SurfacePoint& x, std::size_t rays) {
        Vec3 sum(0.0);
        for (std::size_t k = 0; k < rays; ++k)
            if (const auto y = ray_from(x))
                sum += sent(*y);
        return sum / double(rays);
    }
};

} // namespace

PlainAnswer how_wrong(const Mesh& mesh, const Tracer& tracer, const PatchLight& light,
                      std::span<const SurfacePoint> points, std::size_t rounds, std::size_t walks,
                      std::size_t rays, std::uint64_t seed) {
    const std::vector<Page::Cell> empty(mesh.patches().size());
    Page page{mesh, tracer, light, Rng(seed), empty, empty};
    PlainAnswer answer;
    for (std::size_t round = 0; round < rounds; ++round) {
        double products = 0; // of two groups, whose noise is independent
        for (const SurfacePoint& x : points) {
            const Vec3 first = page.lacking(x, walks), second = page.lacking(x, walks);
            products += glm::dot(first, second);
        }
        answer.squared_error.push_back(products / (3 * double(points.size())));
        page.known = page.pending; // read from the next round on
    }
    for (const SurfacePoint& x : points)
        answer.irradiance.push_back(page.gather(x, rays));
    return answer;
}

} // namespace hemilux
