#include "radiosity/engine/emitters/emitter_choice.h"

#include "bvh/median.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

namespace hemilux {
namespace {

/// The most emitters that a patch weighs one by one; if there are more, it weighs so many clusters.
constexpr std::size_t max_emitters = 1024, max_clusters = 128;

/// Returns the light of each emitter, as the mean of its channels relative to the most that any has
/// in that channel. So an emitter that is faint, but the only one in its channel, is as important
/// as any.
std::vector<double> balanced_light(const Mesh& mesh, std::span<const Patch> emitters) {
    Vec3 most(0.0);
    for (const Patch& patch : emitters)
        most = glm::max(most, mesh.material(patch).emission);
    std::vector<double> light;
    for (const Patch& patch : emitters) {
        double sum = 0;
        for (int c = 0; c < 3; ++c)
            sum += most[c] > 0 ? mesh.material(patch).emission[c] / most[c] : 0;
        light.push_back(sum / 3);
    }
    return light;
}

/// Returns a receiver of no size.
EmitterReceiver receiver_of(const Vec3& centre, const Vec3& normal,
                            const std::array<Vec3, 4>& corners) {
    EmitterReceiver receiver{};
    for (int axis = 0; axis < 3; ++axis) {
        receiver.centre[axis] = centre[axis];
        receiver.normal[axis] = normal[axis];
        for (std::size_t i = 0; i < corners.size(); ++i)
            receiver.corner[i][axis] = corners[i][axis];
    }
    return receiver;
}

} // namespace

EmitterChoice::EmitterChoice(const Mesh& mesh, std::span<const Patch> emitters)
    : mesh_(mesh), emitters_(emitters), order_(emitters.size()), power_sums_(1, 0.0),
      light_(balanced_light(mesh, emitters)) {
    std::iota(order_.begin(), order_.end(), 0u);
    if (!order_.empty())
        divide(add(0, static_cast<std::uint32_t>(order_.size())));
    for (const std::uint32_t place : order_)
        power_sums_.push_back(power_sums_.back() + power_of(place));
    list_emitters();
}

void EmitterChoice::list_emitters() {
    for (const std::uint32_t place : order_) {
        const Patch& patch = emitters_[place];
        auto array = arrays_.begin();
        const auto add = [&](double x) { (array++)->push_back(x); };
        const auto add_point = [&](const Vec3& p) {
            for (int axis = 0; axis < 3; ++axis)
                add(p[axis]);
        };
        add_point(patch.centre);
        add_point(patch.normal);
        for (const Vec3& corner : patch.shape.corner)
            add_point(corner);
        add(patch.area);
        add(std::sqrt(patch.area));
        add(light_[place]);
    }
}

/// Returns the arrays without those before place k.
EmitterArrays EmitterChoice::arrays_from(std::size_t k) const {
    EmitterArrays arrays{};
    auto array = arrays_.begin();
    const auto next = [&] { return (array++)->data() + k; };
    const auto next_point = [&](const double*(&point)[3]) {
        for (const double*& axis : point)
            axis = next();
    };
    next_point(arrays.centre);
    next_point(arrays.normal);
    for (auto& corner : arrays.corner)
        next_point(corner);
    arrays.area = next();
    arrays.side = next();
    arrays.light = next();
    return arrays;
}

double EmitterChoice::power_of(std::uint32_t place) const {
    return emitters_[place].area * light_[place];
}

std::uint32_t EmitterChoice::add(std::uint32_t begin, std::uint32_t end) {
    Cluster cluster{.begin = begin, .end = end};
    for (std::uint32_t k = begin; k < end; ++k) {
        cluster.centre += emitters_[order_[k]].centre / double(end - begin);
        cluster.power += power_of(order_[k]);
        cluster.area += emitters_[order_[k]].area / double(end - begin);
        cluster.light += power_of(order_[k]) * light_[order_[k]];
    }
    cluster.light /= cluster.power;
    for (std::uint32_t k = begin; k < end; ++k)
        cluster.radius =
            std::max(cluster.radius, glm::distance(cluster.centre, emitters_[order_[k]].centre) +
                                         radius_of(emitters_[order_[k]]));
    clusters_.push_back(cluster);
    return static_cast<std::uint32_t>(clusters_.size() - 1);
}

/// Divides a cluster at the median across the widest extent, down to single emitters.
void EmitterChoice::divide(std::uint32_t cluster) {
    const auto [begin, end] = std::pair(clusters_[cluster].begin, clusters_[cluster].end);
    if (end - begin == 1)
        return;
    const auto half =
        halve_at_median(std::span(order_).subspan(begin, end - begin),
                        [this](std::uint32_t place) { return emitters_[place].centre; });
    const std::uint32_t middle = begin + static_cast<std::uint32_t>(half);
    const std::uint32_t left = add(begin, middle), right = add(middle, end);
    clusters_[cluster].left = left;
    clusters_[cluster].right = right;
    divide(left);
    divide(right);
}

/// Returns how much a cluster's emitters differ to the receiver; 0 if there is but one.
double EmitterChoice::nearness(const EmitterReceiver& to, const Cluster& cluster) {
    const Vec3 centre(to.centre[0], to.centre[1], to.centre[2]);
    const double gap = glm::distance(centre, cluster.centre) - to.radius - cluster.radius;
    return cluster.left == 0 ? 0 : cluster.radius / std::max(gap, 1e-3 * cluster.radius);
}

void EmitterChoice::weigh(std::uint32_t receiver, Cut& cut) const {
    const Patch& patch = mesh_.patches()[receiver];
    EmitterReceiver to = receiver_of(patch.centre, patch.normal, patch.shape.corner);
    to.side = std::sqrt(patch.area);
    to.radius = radius_of(patch);
    weigh_all(to, cut);
}

void EmitterChoice::weigh(const Vec3& point, const Vec3& normal, Cut& cut) const {
    weigh_all(receiver_of(point, normal, {point, point, point, point}), cut);
}

void EmitterChoice::weigh_all(const EmitterReceiver& to, Cut& cut) const {
    if (order_.size() <= max_emitters) {
        cut.sums.resize(order_.size() + 1);
        cut.found.resize(order_.size());
        sampling_kernels().weigh_emitters(arrays_from(0), order_.size(), to, cut.sums.data() + 1,
                                          cut.found.data());
    } else {
        choose_clusters(to, cut);
        weigh_clusters(to, cut);
    }
    // Weights become running sums.
    cut.sum = cut.sums[0] = 0;
    for (std::size_t k = 1; k < cut.sums.size(); ++k)
        cut.sums[k] = cut.sum += cut.sums[k];
    cut.square_found = std::accumulate(cut.found.begin(), cut.found.end(), 0.0);
    cut.sums.resize(std::bit_ceil(cut.sums.size()), std::numeric_limits<double>::infinity());
}

/// Divides the cluster that is nearest for its size, as long as there is room.
void EmitterChoice::choose_clusters(const EmitterReceiver& to, Cut& cut) const {
    using Near = std::pair<double, std::uint32_t>;
    thread_local std::vector<Near> heap;
    heap.assign(1, {nearness(to, clusters_.front()), 0});
    while (heap.size() < max_clusters) {
        std::ranges::pop_heap(heap);
        const Cluster& cluster = clusters_[heap.back().second];
        if (cluster.left == 0)
            break;
        heap.back() = {nearness(to, clusters_[cluster.left]), cluster.left};
        std::ranges::push_heap(heap);
        heap.push_back({nearness(to, clusters_[cluster.right]), cluster.right});
        std::ranges::push_heap(heap);
    }
    cut.clusters.clear();
    for (const Near& near : heap)
        cut.clusters.push_back(near.second);
    std::ranges::sort(cut.clusters); // libraries build heaps in different orders
    const auto is_of_many = [&](std::uint32_t c) { return clusters_[c].left != 0; };
    const auto single = std::stable_partition(cut.clusters.begin(), cut.clusters.end(), is_of_many);
    for (auto& array : cut.of_many)
        array.clear();
    for (auto c = cut.clusters.begin(); c != single; ++c) {
        const Cluster& cluster = clusters_[*c];
        const Vec3& centre = cluster.centre;
        auto array = cut.of_many.begin();
        for (const double x : {centre.x, centre.y, centre.z, cluster.radius, cluster.power,
                               cluster.area, cluster.light})
            (array++)->push_back(x);
    }
}

/// Makes weights rather too large than too small, and 0 only where no light can come from.
void EmitterChoice::weigh_clusters(const EmitterReceiver& to, Cut& cut) const {
    const auto& [x, y, z, radius, power, area, light] = cut.of_many;
    cut.sums.resize(cut.clusters.size() + 1);
    cut.found.resize(cut.clusters.size());
    double *weights = cut.sums.data() + 1, *found = cut.found.data();
    sampling_kernels().weigh_clusters(
        {{x.data(), y.data(), z.data()}, radius.data(), power.data(), area.data(), light.data()},
        power.size(), to, weights, found);
    for (std::size_t k = power.size(); k < cut.clusters.size(); ++k)
        sampling_kernels().weigh_emitters(arrays_from(clusters_[cut.clusters[k]].begin), 1, to,
                                          weights + k, found + k);
}

void EmitterChoice::choose(const Cut& cut, const double* u, Choices& choices) const {
    std::array<double, samples_per_block> at;
    std::array<std::uint64_t, samples_per_block> places;
    const double end = std::nextafter(cut.sum, 0.0);
    for (std::size_t k = 0; k < at.size(); ++k)
        at[k] = std::min(u[k] * cut.sum, end);
    sampling_kernels().find_places(cut.sums.data(), cut.sums.size(), at.size(), at.data(),
                                   places.data());
    for (std::size_t k = 0; k < at.size(); ++k) {
        const double before = cut.sums[places[k]], width = cut.sums[places[k] + 1] - before;
        Choice& choice = choices[k];
        if (cut.clusters.empty())
            choice = {order_[places[k]], 1};
        else
            choice = choose_within(clusters_[cut.clusters[places[k]]], (at[k] - before) / width);
        choice.chance *= width / cut.sum;
    }
}

/// Chooses an emitter of the cluster by its power.
EmitterChoice::Choice EmitterChoice::choose_within(const Cluster& cluster, double share) const {
    const double* powers = &power_sums_[cluster.begin]; // of all before each
    const double power = powers[cluster.end - cluster.begin] - powers[0];
    const double at = powers[0] + share * power;
    std::uint32_t k = 0; // the last that is not above, by halves without branches
    for (std::uint32_t size = cluster.end - cluster.begin; size > 1;) {
        const std::uint32_t half = size / 2;
        k += powers[k + half] <= at ? half : 0;
        size -= half;
    }
    return {order_[cluster.begin + k], (powers[k + 1] - powers[k]) / power};
}

} // namespace hemilux
