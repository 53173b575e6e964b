#include "radiosity/engine/stored_transport/importance.h"

#include "radiosity/engine/form_factors/exchange_matrix.h"
#include "radiosity/engine/linear/conjugate_gradients.h"
#include "radiosity/engine/saving/state.h"
#include "radiosity/engine/stored_transport/transport_system.h"
#include "radiosity/engine/target/target.h"
#include "radiosity/paper/scene/alike_neighbours.h"

#include <algorithm>

namespace hemilux {
namespace {

/// The number of patches of a wall that are off by the same.
constexpr double err_together = 64;

/// The sums over the patches of the weight and its square, times the area.
struct WeightSums {
    double first = 0, second = 0;
};

WeightSums sums_of(const Mesh& mesh, std::span<const double> weight) {
    WeightSums sums;
    for (std::size_t i = 0; i < weight.size(); ++i) {
        sums.first += weight[i] * mesh.patches()[i].area;
        sums.second += weight[i] * weight[i] * mesh.patches()[i].area;
    }
    return sums;
}

} // namespace

std::vector<Vec3> importance_of(const ExchangeMatrix& factors, std::span<const double> area,
                                std::span<const Vec3> reflectance, std::span<const double> weight,
                                const Workers& workers, double tolerance) {
    std::vector<Vec3> source;
    for (const double w : weight)
        source.emplace_back(w);
    std::vector<Vec3> importance(weight.size(), Vec3(0.0));
    // Rays are allocated by it, and right on average however they are: a rough one will do.
    static_cast<void>(
        solve_by_gradients(factors, area, reflectance, source, importance, workers, tolerance));
    return importance;
}

std::vector<double> importance_of_rays(const Mesh& mesh, std::span<const Vec3> importance,
                                       std::span<const double> weight) {
    const auto patches = mesh.patches();
    const WeightSums sums = sums_of(mesh, weight);
    const auto through_others = [&](std::uint32_t i) { return importance[i] - weight[i]; };
    std::vector<double> result;
    for (std::uint32_t i = 0; i < weight.size(); ++i) {
        Vec3 sum = through_others(i);
        double count = 1;
        for_alike_neighbours(mesh, i, [&](std::uint32_t j) {
            sum += through_others(j);
            ++count;
        });
        const Vec3 mean = sum / count;
        const double through = patches[i].area * glm::dot(mean, mean) / (3 * sums.first);
        const double counts = weight[i] + err_together * through;
        result.push_back(counts * sums.first / sums.second);
    }
    return result;
}

TargetAim::TargetAim(const Mesh& mesh, std::span<const double> weight)
    : weight_(weight), learned_(weight.size()), of_rays_(weight.size()) {
    if (has_target()) {
        const WeightSums sums = sums_of(mesh, weight);
        unit_ = sums.second / sums.first;
    }
}

/// Keeps a least importance: where light cannot leave for the target, as far as is known, it may
/// yet turn out to.
void TargetAim::renew(const Mesh& mesh, const TransportSystem& system,
                      const ExchangeMatrix& factors, const Workers& workers) {
    constexpr double least = 1e-9, roughly = .1; // numbers of rays are as its power 0.8
    learned_ = importance_of_rays(
        mesh,
        importance_of(factors, system.area(), system.reflectance(), weight_, workers, roughly),
        weight_);
    for (double& each : learned_)
        each = std::max(each, least);
    is_outdated_ = false;
    leave_out_unneeded();
}

void TargetAim::step_done(std::span<const std::uint32_t> part, const std::vector<bool>& lit) {
    std::vector<bool> holds_target(part.size()), needed(part.size(), true);
    bool target_is_lit = false;
    for (std::size_t i = 0; i < part.size(); ++i)
        if (weight_[i] > 0) {
            holds_target[part[i]] = true;
            target_is_lit = target_is_lit || lit[i];
        }
    is_outdated_ = is_outdated_ || needed_.empty();
    unneeded_ = 0;
    for (std::size_t i = 0; i < part.size(); ++i) {
        needed[i] = !target_is_lit || holds_target[part[i]];
        unneeded_ += lit[i] && !needed[i];
        is_outdated_ = is_outdated_ || (needed[i] && !needed_[i]);
    }
    needed_ = std::move(needed);
    leave_out_unneeded();
}

void TargetAim::leave_out_unneeded() {
    of_rays_ = learned_;
    for (std::size_t i = 0; i < needed_.size(); ++i)
        if (!needed_[i])
            of_rays_[i] = 0;
}

double TargetAim::counts_alone(std::uint32_t patch) const {
    const double through = of_rays_[patch] * unit_ - weight_[patch];
    return weight_[patch] + std::max(through, 0.0) / err_together;
}

void TargetAim::save(StateWriter& state) const {
    if (!has_target())
        return;
    state.add(hash_of_weights(weight_));
    state.add(std::span<const double>(learned_));
    state.add(std::uint64_t{!needed_.empty()});
    for (const bool each : needed_)
        state.add(std::uint64_t{each});
    state.add(std::uint64_t{unneeded_});
    state.add(std::uint64_t{is_outdated_});
}

void TargetAim::load(StateReader& state) {
    if (!has_target())
        return;
    if (state.whole() != hash_of_weights(weight_))
        throw StateError("what the run was for is not what it is for this time");
    state.get(std::span(learned_), bounds::non_negative);
    needed_.resize(state.flag() ? learned_.size() : 0);
    for (std::size_t i = 0; i < needed_.size(); ++i)
        needed_[i] = state.flag();
    leave_out_unneeded();
    unneeded_ = state.whole_up_to(learned_.size());
    is_outdated_ = state.flag();
}

} // namespace hemilux
