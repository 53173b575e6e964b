#include "radiosity/emitter_choice.h"

#include "radiosity/mesh.h"
#include "radiosity/pair_factor.h"
#include "radiosity/shot.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace hemilux {
namespace {

/// That a patch weighs.
constexpr std::size_t most_clusters = 128;

/// The place of u among running sums.
std::size_t place_of(double u, std::span<const double> sums) {
    const auto drawn = std::ranges::upper_bound(sums, u);
    return std::min(static_cast<std::size_t>(drawn - sums.begin()), sums.size() - 1);
}

} // namespace

EmitterChoice::EmitterChoice(const Mesh& mesh, std::span<const std::uint32_t> emitters)
    : mesh_(mesh), emitters_(emitters), order_(emitters.size()), power_sums_(1, 0.0) {
    for (const Patch& patch : mesh.patches())
        radius_.push_back(radius_of(patch));
    std::iota(order_.begin(), order_.end(), 0u);
    if (!order_.empty())
        divide(add(0, static_cast<std::uint32_t>(order_.size())));
    for (const std::uint32_t place : order_)
        power_sums_.push_back(power_sums_.back() + power_of(place));
}

const Vec3& EmitterChoice::centre(std::uint32_t place) const {
    return mesh_.patches()[emitters_[place]].centre;
}

double EmitterChoice::power_of(std::uint32_t place) const {
    return mesh_.patches()[emitters_[place]].area *
           mean_of_channels(mesh_.material(emitters_[place]).emission);
}

std::uint32_t EmitterChoice::add(std::uint32_t begin, std::uint32_t end) {
    Cluster cluster{.begin = begin, .end = end};
    for (std::uint32_t k = begin; k < end; ++k) {
        cluster.centre += centre(order_[k]) / double(end - begin);
        cluster.power += power_of(order_[k]);
    }
    for (std::uint32_t k = begin; k < end; ++k)
        cluster.radius = std::max(cluster.radius, glm::distance(cluster.centre, centre(order_[k])) +
                                                      radius_[emitters_[order_[k]]]);
    clusters_.push_back(cluster);
    return static_cast<std::uint32_t>(clusters_.size() - 1);
}

/// At the median across the widest extent, down to single emitters.
void EmitterChoice::divide(std::uint32_t cluster) {
    const auto [begin, end] = std::pair(clusters_[cluster].begin, clusters_[cluster].end);
    if (end - begin == 1)
        return;
    Vec3 low = centre(order_[begin]), high = low;
    for (std::uint32_t k = begin; k < end; ++k) {
        low = glm::min(low, centre(order_[k]));
        high = glm::max(high, centre(order_[k]));
    }
    const Vec3 extent = high - low;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0
                     : extent.y >= extent.z                       ? 1
                                                                  : 2;
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) {
                         return centre(a)[axis] != centre(b)[axis]
                                    ? centre(a)[axis] < centre(b)[axis]
                                    : a < b;
                     });
    const std::uint32_t left = add(begin, middle), right = add(middle, end);
    clusters_[cluster].left = left;
    clusters_[cluster].right = right;
    divide(left);
    divide(right);
}

/// How much the mean square of the kernel exceeds the square of its value between the centres, as
/// points of the receiver come nearer to the emitter.
double EmitterChoice::excess(std::uint32_t receiver, double distance, double area) const {
    const double nearest = std::max(distance - radius_[receiver], 0.0);
    return (std::numbers::pi * distance * distance + area) /
           (std::numbers::pi * nearest * nearest + area);
}

double EmitterChoice::weight_of_one(std::uint32_t receiver, std::uint32_t emitter) const {
    const Patch &to = mesh_.patches()[receiver], &from = mesh_.patches()[emitter];
    if (emitter == receiver || !may_see(to, from))
        return 0;
    return mean_of_channels(mesh_.material(emitter).emission) * rough_factor(to, from) *
           std::sqrt(excess(receiver, glm::distance(to.centre, from.centre), from.area));
}

/// Rather too large than too small, and 0 only where no light can come from.
double EmitterChoice::weight(std::uint32_t receiver, const Cluster& cluster) const {
    if (cluster.left == 0)
        return weight_of_one(receiver, emitters_[order_[cluster.begin]]);
    const Patch& to = mesh_.patches()[receiver];
    const Vec3 d = cluster.centre - to.centre;
    const double reach = cluster.radius + radius_[receiver], r = glm::length(d);
    const double height = glm::dot(to.normal, d) + reach;
    const double cosine = r > reach ? std::min(height / r, 1.0) : 1.0;
    const double area = std::numbers::pi * cluster.radius * cluster.radius;
    return cosine > 0 ? cluster.power * cosine / (std::numbers::pi * r * r + area) *
                            std::sqrt(excess(receiver, r, area))
                      : 0;
}

/// How much a cluster's emitters differ to the receiver; 0 where there is but one.
double EmitterChoice::nearness(std::uint32_t receiver, const Cluster& cluster) const {
    const double gap = glm::distance(mesh_.patches()[receiver].centre, cluster.centre) -
                       radius_[receiver] - cluster.radius;
    return cluster.left == 0 ? 0 : cluster.radius / std::max(gap, 1e-3 * cluster.radius);
}

/// The cluster that is nearest for its size is divided as long as there is room.
void EmitterChoice::weigh(std::uint32_t receiver, Cut& cut) const {
    cut.clusters.clear();
    cut.sums.clear();
    if (clusters_.empty())
        return;
    using Near = std::pair<double, std::uint32_t>;
    thread_local std::vector<Near> heap;
    heap.assign(1, {nearness(receiver, clusters_.front()), 0});
    const std::size_t room = std::min(most_clusters, order_.size());
    while (heap.size() < room) {
        std::ranges::pop_heap(heap);
        const Cluster& cluster = clusters_[heap.back().second];
        if (cluster.left == 0)
            break;
        heap.back() = {nearness(receiver, clusters_[cluster.left]), cluster.left};
        std::ranges::push_heap(heap);
        heap.push_back({nearness(receiver, clusters_[cluster.right]), cluster.right});
        std::ranges::push_heap(heap);
    }
    double sum = 0;
    for (const Near& near : heap) {
        cut.clusters.push_back(near.second);
        cut.sums.push_back(sum += weight(receiver, clusters_[near.second]));
    }
}

EmitterChoice::Choice EmitterChoice::choose(const Cut& cut, double u) const {
    const double all = cut.sums.back();
    const double at = std::min(u * all, std::nextafter(all, 0.0));
    const std::size_t c = place_of(at, cut.sums);
    const double before = c > 0 ? cut.sums[c - 1] : 0, width = cut.sums[c] - before;
    const Cluster& cluster = clusters_[cut.clusters[c]];
    const std::span powers(&power_sums_[cluster.begin + 1], cluster.end - cluster.begin);
    const double first = power_sums_[cluster.begin], power = powers.back() - first;
    const std::size_t k = place_of(first + (at - before) / width * power, powers);
    const double own = powers[k] - power_sums_[cluster.begin + k];
    return {order_[cluster.begin + k], width / all * own / power};
}

} // namespace hemilux
