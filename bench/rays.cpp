#include "rays.h"

#include "radiosity/paper/sampling/rng.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace hemilux::bench {
namespace {

/// Interleaves the bits of up to three coordinates in [0,1): neighbours in space follow each other.
std::uint64_t morton(std::initializer_list<double> at, int bits) {
    std::uint64_t key = 0;
    for (int b = bits - 1; b >= 0; --b)
        for (const double x : at)
            key = key << 1 | (static_cast<std::uint64_t>(x * double(1 << bits)) >> b & 1);
    return key;
}

std::vector<std::uint32_t> in_spatial_order(const Mesh& mesh) {
    std::vector<std::uint64_t> key;
    for (const Patch& patch : mesh.patches()) {
        const Vec3 p = 0.49 * (patch.centre + 1.0);
        key.push_back(morton({p.x, p.y, p.z}, 16));
    }
    std::vector<std::uint32_t> order(key.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return key[a] < key[b]; });
    return order;
}

/// Cosine distributed through equal areas of the disc, and the cell of the disc it lies in.
struct Direction {
    Vec3 local;
    std::uint64_t cell;
};

Direction sample(Rng& rng, int bits) {
    const double s = rng.uniform(), t = rng.uniform();
    const double a = 2 * s - 1, b = 2 * t - 1; // the square's rings become the disc's
    const bool wide = std::abs(a) > std::abs(b);
    const double r = wide ? a : b;
    const double quarter = std::numbers::pi / 4;
    const double phi = r == 0 ? 0 : wide ? quarter * b / a : 2 * quarter - quarter * a / b;
    const double x = r * std::cos(phi), y = r * std::sin(phi);
    return {{x, y, std::sqrt(std::max(0.0, 1 - x * x - y * y))}, morton({s, t}, bits)};
}

void add_patch(const Mesh& mesh, std::uint32_t index, std::size_t count, Rng& rng, RaySet& set) {
    const Patch& patch = mesh.patches()[index];
    const Frame frame = mesh.hemisphere_frame(index);
    const int bits = count >= 1024 ? 5 : 3;
    std::vector<Direction> directions;
    for (std::size_t k = 0; k < count; ++k)
        directions.push_back(sample(rng, bits));
    std::stable_sort(directions.begin(), directions.end(),
                     [](const Direction& a, const Direction& b) { return a.cell < b.cell; });
    const double u = rng.uniform(), v = rng.uniform();
    const Vec3 origin = patch.shape.sample({u, v});
    for (const Direction& d : directions)
        set.sorted.push_back(
            {.origin = origin, .direction = frame.to_world(d.local), .from = patch.facet});
}

} // namespace

RaySet make_rays(const Mesh& mesh, std::size_t per_patch, std::size_t total) {
    const std::vector<std::uint32_t> order = in_spatial_order(mesh);
    constexpr std::size_t runs = 16;
    const std::size_t patches = std::max<std::size_t>(runs, total / per_patch);
    const std::size_t length =
        std::min(patches / runs, std::max<std::size_t>(1, order.size() / runs));
    RaySet set;
    Rng rng(1);
    for (std::size_t r = 0; r < runs; ++r)
        for (std::size_t k = 0; k < length; ++k)
            add_patch(mesh, order[(r * order.size() / runs + k) % order.size()], per_patch, rng,
                      set);
    set.shuffled = set.sorted;
    for (std::size_t k = set.shuffled.size(); k > 1; --k)
        std::swap(set.shuffled[k - 1],
                  set.shuffled[static_cast<std::size_t>(rng.uniform() * double(k))]);
    return set;
}

ShadowRaySet make_shadow_rays(const Mesh& mesh, const RaySet& set) {
    std::vector<Vec3> normal(mesh.soup().facets.size(), Vec3(0.0));
    for (const Patch& patch : mesh.patches())
        normal[patch.facet] = patch.normal;
    constexpr double grazing = 1e-3, end = 1 - 1e-4;
    constexpr std::size_t tries = 4; // a ray, in the mean
    Rng rng(2);
    const std::vector<Ray>& from = set.shuffled;
    ShadowRaySet shadow;
    for (std::size_t k = 0; k < tries * from.size() && shadow.rays.size() < from.size(); ++k) {
        const Ray& a = from[k % from.size()];
        const Ray& b = from[static_cast<std::size_t>(rng.uniform() * double(from.size()))];
        const Vec3 way = b.origin - a.origin;
        const double length = glm::length(way);
        if (glm::dot(normal[a.from], way) > grazing * length &&
            glm::dot(normal[b.from], way) < -grazing * length) {
            shadow.rays.push_back({.origin = a.origin,
                                   .direction = way / length,
                                   .t_max = end * length,
                                   .from = a.from});
            shadow.targets.push_back(b.from);
        }
    }
    return shadow;
}

} // namespace hemilux::bench
