#include "radiosity/light_paths.h"

#include "geometry/frame.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace hemilux {
namespace {

/// In the local frame, of a size of about 1: more than the layers of one place are apart, less than
/// a lamp is from its ceiling.
constexpr double off_the_plane = 0x1p-23;

Vec3 normal_of(const Mesh& mesh, FacetSide side) {
    const Vec3 normal = mesh.whole_side(side.facet, false).normal;
    return side.back ? -normal : normal;
}

} // namespace

Ray diffuse_ray(const Mesh& mesh, FacetSide side, const Vec3& point, Rng& rng) {
    const double u = rng.uniform(), angle = 2 * std::numbers::pi * rng.uniform();
    const Vec3 local(std::sqrt(u) * std::cos(angle), std::sqrt(u) * std::sin(angle),
                     std::sqrt(1 - u));
    const Vec3 direction = Frame::from_normal(normal_of(mesh, side)).to_world(local);
    return {.origin = point, .direction = direction, .t_min = off_the_plane, .from = side.facet};
}

Ray diffuse_ray(const Mesh& mesh, FacetSide side, Rng& rng) {
    const Vec2 u(rng.uniform(), rng.uniform());
    return diffuse_ray(mesh, side, mesh.whole_side(side.facet, false).shape.sample(u), rng);
}

double power_of(const Mesh& mesh, std::uint32_t facet) {
    const Vec3& e = mesh.scene().materials[mesh.scene().facets[facet].material].emission;
    const double sum = e.r + e.g + e.b;
    if (!(sum > 0) || !std::isfinite(sum))
        return 0;
    return sum * mesh.whole_side(facet, false).area;
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

} // namespace hemilux
