#include "support/families/walks.h"

#include "geometry/frame.h"
#include "radiosity/paper/sampling/rng.h"
#include "support/statistics.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <vector>

namespace hemilux::test {
namespace {

/// Chooses patches with probabilities in proportion to their values.
class Choice {
  public:
    Choice(std::vector<std::uint32_t> patches, const std::vector<double>& values)
        : patches_(std::move(patches)), sums_(values.size()) {
        std::partial_sum(values.begin(), values.end(), sums_.begin());
    }
    [[nodiscard]] std::uint32_t draw(Rng& rng) const {
        const auto at = std::ranges::upper_bound(sums_, rng.uniform() * sums_.back());
        return patches_[std::min(static_cast<std::size_t>(at - sums_.begin()), sums_.size() - 1)];
    }

  private:
    std::vector<std::uint32_t> patches_;
    std::vector<double> sums_;
};

Choice by_area(const Mesh& mesh, std::span<const std::uint32_t> group) {
    std::vector<double> areas;
    for (const std::uint32_t i : group)
        areas.push_back(mesh.patches()[i].area);
    return {{group.begin(), group.end()}, areas};
}

std::vector<std::uint32_t> emitters_of(const Mesh& mesh) {
    std::vector<std::uint32_t> emitters;
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i)
        if (mesh.material(i).emission.x > 0)
            emitters.push_back(i);
    return emitters;
}

class RandomWalk {
  public:
    RandomWalk(const Mesh& mesh, const Tracer& tracer, std::uint64_t seed)
        : mesh_(mesh), tracer_(tracer), rng_(seed), emitters_(emitters_of(mesh)) {}

    Rng& rng() { return rng_; }

    /// Reflected radiosity of a patch. A walk ends at a patch with the probability that light does,
    /// so that all its vertices have the same weight.
    double reflected(std::uint32_t start) {
        double light = 0;
        std::optional<std::uint32_t> patch = start;
        do {
            const Vec3 point = point_on(*patch);
            light += direct_light(*patch, point);
            patch = next(*patch, point);
        } while (patch && rng_.uniform() < mesh_.material(*patch).reflectance.x);
        return mesh_.material(start).reflectance.x * light;
    }

  private:
    Vec2 pair() {
        const double u = rng_.uniform();
        return {u, rng_.uniform()};
    }
    Vec3 point_on(std::uint32_t patch) { return mesh_.patches()[patch].shape.sample(pair()); }

    /// The power of an emitter times the kernel cos cos / (pi r^2) to a point of it, times their
    /// number. All are chosen alike: a sun has nearly all power, and gives little light.
    double direct_light(std::uint32_t patch, const Vec3& point) {
        const Patch& from = mesh_.patches()[patch];
        const auto count = static_cast<double>(emitters_.size());
        const std::uint32_t emitter = emitters_[static_cast<std::size_t>(rng_.uniform() * count)];
        const Patch& to = mesh_.patches()[emitter];
        const Vec3 d = point_on(emitter) - point;
        const double cosines = -glm::dot(d, from.normal) * glm::dot(d, to.normal);
        if (emitter == patch || glm::dot(d, from.normal) <= 0 || cosines <= 0)
            return 0;
        Ray ray{point, d};
        ray.t_max = 1 - 1e-9;
        ray.from = from.facet;
        if (tracer_.occluded(ray, to.facet))
            return 0;
        const double square = glm::dot(d, d);
        const double power = to.area * mesh_.material(emitter).emission.x;
        return count * power * cosines / (std::numbers::pi * square * square);
    }

    /// The patch that a ray strikes; none outside of the scene and on the back of a facet.
    std::optional<std::uint32_t> next(std::uint32_t patch, const Vec3& point) {
        const Vec2 u = pair();
        const double radius = std::sqrt(u.x), angle = 2 * std::numbers::pi * u.y;
        const Frame frame = Frame::from_normal(mesh_.patches()[patch].normal);
        Ray ray{point, frame.to_world({radius * std::cos(angle), radius * std::sin(angle),
                                       std::sqrt(1 - u.x)})};
        ray.from = mesh_.patches()[patch].facet;
        const std::optional<Hit> hit = tracer_.closest(ray);
        if (!hit || mesh_.patch_at(*hit) == none)
            return std::nullopt;
        return mesh_.patch_at(*hit);
    }

    const Mesh& mesh_;
    const Tracer& tracer_;
    Rng rng_;
    std::vector<std::uint32_t> emitters_;
};

} // namespace

WalkResult walk(const Mesh& mesh, const Tracer& tracer, std::span<const std::uint32_t> group,
                std::uint64_t walks, std::uint64_t seed) {
    RandomWalk walk(mesh, tracer, seed);
    const Choice starts = by_area(mesh, group);
    MeanTest mean;
    for (std::uint64_t k = 0; k < walks; ++k)
        mean.add(walk.reflected(starts.draw(walk.rng())));
    return {mean.mean(), mean.standard_error()};
}

} // namespace hemilux::test
