#include "radiosity/emitter_choice.h"

#include "radiosity/mesh.h"
#include "radiosity/pair_factor.h"
#include "radiosity/shot.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace hemilux {
namespace {

constexpr std::size_t most_clusters = 128;

double radius_of(const Patch& patch) {
    double squares = 0;
    for (const Vec3& corner : patch.shape.corner)
        squares = std::max(squares, glm::dot(corner - patch.centre, corner - patch.centre));
    return std::sqrt(squares);
}

/// The place of u among running sums that begin at 0.
std::size_t place_of(double u, std::span<const double> sums) {
    const auto drawn = std::ranges::upper_bound(sums, u);
    return std::min(static_cast<std::size_t>(drawn - sums.begin()), sums.size() - 1);
}

double before(std::span<const double> sums, std::size_t place) {
    return place > 0 ? sums[place - 1] : 0;
}

} // namespace

EmitterChoice::EmitterChoice(const Mesh& mesh, std::span<const std::uint32_t> emitters)
    : mesh_(mesh), emitters_(emitters), order_(emitters.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    if (!order_.empty())
        divide(0, static_cast<std::uint32_t>(order_.size()),
               std::min(most_clusters, order_.size()));
}

const Vec3& EmitterChoice::centre(std::uint32_t place) const {
    return mesh_.patches()[emitters_[place]].centre;
}

/// At the median across the widest extent, until there are so many clusters.
void EmitterChoice::divide(std::uint32_t begin, std::uint32_t end, std::size_t clusters) {
    if (clusters == 1)
        return add_cluster(begin, end);
    Vec3 low = centre(order_[begin]), high = low;
    for (std::uint32_t k = begin; k < end; ++k) {
        low = glm::min(low, centre(order_[k]));
        high = glm::max(high, centre(order_[k]));
    }
    const Vec3 extent = high - low;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0
                     : extent.y >= extent.z                       ? 1
                                                                  : 2;
    const std::size_t left = clusters / 2;
    const auto middle = begin + static_cast<std::uint32_t>((end - begin) * left / clusters);
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) {
                         return centre(a)[axis] != centre(b)[axis]
                                    ? centre(a)[axis] < centre(b)[axis]
                                    : a < b;
                     });
    divide(begin, middle, left);
    divide(middle, end, clusters - left);
}

void EmitterChoice::add_cluster(std::uint32_t begin, std::uint32_t end) {
    std::sort(order_.begin() + begin, order_.begin() + end);
    Cluster cluster{begin, end, Vec3(0.0), 0, 0};
    for (std::uint32_t k = begin; k < end; ++k) {
        const Patch& patch = mesh_.patches()[emitters_[order_[k]]];
        cluster.centre += patch.centre / double(end - begin);
        cluster.power +=
            patch.area * mean_of_channels(mesh_.material(emitters_[order_[k]]).emission);
        power_sums_.push_back(cluster.power);
    }
    for (std::uint32_t k = begin; k < end; ++k) {
        const Patch& patch = mesh_.patches()[emitters_[order_[k]]];
        cluster.radius = std::max(cluster.radius,
                                  glm::distance(cluster.centre, patch.centre) + radius_of(patch));
    }
    clusters_.push_back(cluster);
}

/// Rather too large than too small, and 0 only where no light can come from.
double EmitterChoice::weight(std::uint32_t receiver, const Cluster& cluster) const {
    const Patch& to = mesh_.patches()[receiver];
    if (cluster.end - cluster.begin == 1) {
        const std::uint32_t e = emitters_[order_[cluster.begin]];
        const Patch& from = mesh_.patches()[e];
        return e != receiver && may_see(to, from)
                   ? mean_of_channels(mesh_.material(e).emission) * rough_factor(to, from)
                   : 0;
    }
    const Vec3 d = cluster.centre - to.centre;
    const double reach = cluster.radius + radius_of(to), r2 = glm::dot(d, d);
    const double height = glm::dot(to.normal, d) + reach;
    const double cosine = r2 > reach * reach ? std::min(height / std::sqrt(r2), 1.0) : 1.0;
    return cosine > 0 ? cluster.power * cosine / (std::numbers::pi * (r2 + reach * reach)) : 0;
}

void EmitterChoice::weigh(std::uint32_t receiver, std::vector<double>& sums) const {
    sums.clear();
    double sum = 0;
    for (const Cluster& cluster : clusters_)
        sums.push_back(sum += weight(receiver, cluster));
}

EmitterChoice::Choice EmitterChoice::choose(std::span<const double> sums, double u) const {
    const double at = std::min(u * sums.back(), std::nextafter(sums.back(), 0.0));
    const std::size_t c = place_of(at, sums);
    const Cluster& cluster = clusters_[c];
    const double first = before(sums, c), width = sums[c] - first;
    const std::span powers(&power_sums_[cluster.begin], cluster.end - cluster.begin);
    const std::size_t k = place_of((at - first) / width * cluster.power, powers);
    return {order_[cluster.begin + k],
            width / sums.back() * (powers[k] - before(powers, k)) / cluster.power};
}

} // namespace hemilux
