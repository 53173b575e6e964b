#include "path_reference.h"

#include "geometry/frame.h"
#include "radiosity/paper/rays/shot.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hemilux::bench {
namespace {

double uniform(std::mt19937_64& numbers) {
    return std::uniform_real_distribution<double>(0, 1)(numbers);
}

Vec3 cosine_distributed(const Vec3& normal, const std::array<double, 2>& numbers) {
    const double radius = std::sqrt(numbers[0]);
    const double angle = 2 * std::numbers::pi * numbers[1];
    const Vec3 direction(radius * std::cos(angle), radius * std::sin(angle),
                         std::sqrt(std::max(1 - radius * radius, 0.0)));
    return Frame::from_normal(normal).to_world(direction);
}

/// Irradiance by a point that emits 1 W/m2, per area; both normals are unit.
double kernel(const SurfacePoint& at, const Vec3& point, const Vec3& normal) {
    const Vec3 way = point - at.position;
    const double square = glm::dot(way, way);
    const double product = glm::dot(way, at.normal) * -glm::dot(way, normal);
    return glm::dot(way, at.normal) > 0 && product > 0
               ? product / (std::numbers::pi * square * square)
               : 0;
}

} // namespace

PathReference::PathReference(const Mesh& mesh, const Tracer& tracer)
    : mesh_(mesh), tracer_(tracer) {
    for (const Patch& side : mesh.patches())
        if (const double emission = mean_of_channels(mesh.material(side).emission); emission > 0) {
            emitters_.push_back(side);
            power_sums_.push_back((power_sums_.empty() ? 0 : power_sums_.back()) +
                                  side.area * emission);
        }
}

double PathReference::density(const Patch& side) const {
    return mean_of_channels(mesh_.material(side).emission) / power_sums_.back();
}

Vec3 PathReference::from_emitter(const SurfacePoint& at,
                                 const std::array<double, 3>& numbers) const {
    const double power = numbers[0] * power_sums_.back();
    const auto place = std::ranges::upper_bound(power_sums_, power) - power_sums_.begin();
    const Patch& side =
        emitters_[std::min<std::size_t>(static_cast<std::size_t>(place), emitters_.size() - 1)];
    const Vec3 point = PolygonSampler(side.shape).sample({numbers[1], numbers[2]});
    // The density of a random ray there is this kernel too.
    const double arrives = kernel(at, point, side.normal);
    Ray ray{at.position, point - at.position};
    ray.t_max = 1 - 1e-9;
    ray.from = at.facet;
    if (!(arrives > 0) || tracer_.occluded(ray, side.facet))
        return Vec3(0.0);
    return arrives / (arrives + density(side)) * colours_at(mesh_, side, point).emission;
}

Vec3 PathReference::irradiance(const SurfacePoint& at, std::size_t paths,
                               std::mt19937_64& numbers) const {
    // Powers of 1 / g with g^6 = g + 1: the golden ratio for five dimensions (Roberts 2018).
    constexpr double g = 1.134724138401519492605446;
    std::array<double, 5> shift{}, step{};
    for (std::size_t i = 0; i < step.size(); ++i) {
        shift[i] = uniform(numbers);
        step[i] = i > 0 ? step[i - 1] / g : 1 / g;
    }
    Vec3 found(0.0);
    for (std::size_t path = 0; path < paths; ++path) {
        const auto spread = [&](std::size_t i) {
            const double x = shift[i] + double(path) * step[i];
            return x - std::floor(x);
        };
        found +=
            along_path(at, {{spread(0), spread(1), spread(2)}, {spread(3), spread(4)}}, numbers);
    }
    return found / double(paths);
}

Vec3 PathReference::along_path(SurfacePoint at, Vertex vertex, std::mt19937_64& numbers) const {
    Vec3 found(0.0), weight(1.0);
    if (emitters_.empty())
        return found;
    for (;;) {
        found += weight * from_emitter(at, vertex.emitter);
        Ray ray{at.position, cosine_distributed(at.normal, vertex.direction)};
        ray.from = at.facet;
        const auto hit = tracer_.closest(ray);
        const std::uint32_t patch = hit ? mesh_.patch_at(*hit) : none;
        if (patch == none)
            return found;
        const Patch& side = mesh_.patches()[patch];
        const Vec3 point = ray.origin + hit->t * ray.direction;
        const Colours material = colours_at(mesh_, side, point);
        if (material.emission != Vec3(0.0) && density(side) > 0) {
            const double arrives = kernel(at, point, side.normal);
            found += arrives / (arrives + density(side)) * weight * material.emission;
        }
        const Vec3& rho = material.reflectance;
        const double kept = std::max({rho.x, rho.y, rho.z});
        if (!(uniform(numbers) < kept))
            return found;
        weight *= rho / kept;
        at = {point, side.normal, side.facet};
        for (double& number : vertex.emitter)
            number = uniform(numbers);
        for (double& number : vertex.direction)
            number = uniform(numbers);
    }
}

} // namespace hemilux::bench
