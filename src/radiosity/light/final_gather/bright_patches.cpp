#include "radiosity/light/final_gather/bright_patches.h"

#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <numeric>

namespace hemilux {
namespace {

/// The share of the surface of all patches that bright ones may cover.
constexpr double share_of_surface = 1. / 16;

/// The most bright patches: more chances take longer than the rays of the points that share them.
constexpr std::size_t max_patches = 4096;

} // namespace

BrightPatches::BrightPatches(const Mesh& mesh, std::span<const Vec3> radiosity,
                             const ReachedEmitters& emitters)
    : mesh_(mesh), number_(radiosity.size(), none) {
    std::vector<double> light;
    double surface = 0;
    for (std::uint32_t i = 0; i < radiosity.size(); ++i) {
        light.push_back(mean_of_channels(radiosity[i] - emitters.emission(i)));
        surface += mesh.patches()[i].area;
    }
    std::vector<std::uint32_t> order(radiosity.size());
    std::iota(order.begin(), order.end(), 0u);
    const std::size_t some = std::min(order.size(), max_patches);
    std::ranges::partial_sort(order, order.begin() + static_cast<std::ptrdiff_t>(some),
                              [&](std::uint32_t a, std::uint32_t b) {
                                  return light[a] != light[b] ? light[a] > light[b] : a < b;
                              });
    double covered = 0;
    for (const std::uint32_t i : std::span(order).first(some)) {
        const Patch& patch = mesh.patches()[i];
        covered += patch.area;
        if (covered > share_of_surface * surface || light[i] <= 0)
            break;
        number_[i] = static_cast<std::uint32_t>(patches_.size());
        patches_.push_back({i, patch.area * light[i], PolygonSampler(patch.shape)});
    }
}

/// Leaves a patch that is near for its size to random rays.
void BrightPatches::aim(const SurfacePoint& point, Aim& aim) const {
    aim.ends.resize(patches_.size());
    double sum = 0;
    for (std::size_t k = 0; k < patches_.size(); ++k) {
        const Patch& patch = mesh_.patches()[patches_[k].patch];
        const Vec3 way = patch.centre - point.position;
        const double squared = glm::dot(way, way), here = glm::dot(way, point.normal),
                     there = -glm::dot(way, patch.normal);
        if (here > 0 && there > 0 && patch.area < squared)
            sum += patches_[k].power * here * there / (squared * squared);
        aim.ends[k] = sum;
    }
}

BrightPatches::Target BrightPatches::draw(const SurfacePoint& point, const Aim& aim,
                                          const Vec3& u) const {
    const auto found = std::ranges::upper_bound(aim.ends, u.x * aim.ends.back());
    const auto k = std::min<std::ptrdiff_t>(found - aim.ends.begin(),
                                            static_cast<std::ptrdiff_t>(patches_.size()) - 1);
    const Bright& bright = patches_[static_cast<std::size_t>(k)];
    return {glm::normalize(bright.points.sample({u.y, u.z}) - point.position), bright.patch};
}

double BrightPatches::density(const Aim& aim, std::uint32_t patch, double t,
                              const Vec3& direction) const {
    const std::uint32_t k = number_[patch];
    if (k == none)
        return 0;
    const double chance = (aim.ends[k] - (k > 0 ? aim.ends[k - 1] : 0)) / aim.ends.back();
    const Patch& met = mesh_.patches()[patch];
    return chance * t * t / (met.area * std::abs(glm::dot(direction, met.normal)));
}

} // namespace hemilux
