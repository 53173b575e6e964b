#include "radiosity/engine/stored_transport/ray_weights.h"

#include "geometry/elementary.h"
#include "radiosity/engine/saving/state.h"
#include "radiosity/paper/scene/alike_neighbours.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace hemilux {
namespace {

/// The share of the weights that is measured, and the power of a patch's area that counts.
constexpr double trust = .5, area_exponent = .42;

/// Black emitters count as if they reflected this: their rays show where their light goes.
constexpr double min_reflectance = .1;

} // namespace

RayWeights::RayWeights(const Mesh& mesh, const Needs& needs) : mesh_(mesh) {
    double largest = 0; // hardly a ray from the huge surface of a sky meets the scene
    for (const Patch& patch : mesh.patches())
        if (!mesh.material(patch).is_far)
            largest = std::max(largest, patch.area);
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i) {
        reflectance_.push_back(mesh.material(i).reflectance);
        const double reflectance = glm::length(reflectance_[i]);
        const double counted = std::min(mesh.patches()[i].area, largest);
        const double area = needs.power(i) ? elementary::pow(counted, area_exponent) : 0;
        prior_to_emitters_.push_back(area * reflectance);
        prior_random_.push_back(area * std::max(reflectance, min_reflectance));
    }
    random_ = learned_random_ = prior_random_;
    to_emitters_ = prior_to_emitters_;
}

void RayWeights::leave_out(const std::vector<bool>& lit) {
    if (std::ranges::none_of(lit, std::identity{})) // nothing is known yet
        return;
    for (std::size_t i = 0; i < lit.size(); ++i)
        if (!lit[i])
            random_[i] = to_emitters_[i] = 0;
}

/// Returns the mean over a patch's neighbours; of the patch itself where it has none.
double RayWeights::of_neighbours(std::uint32_t patch, std::span<const double> known) const {
    double sum = 0, count = 0;
    for_alike_neighbours(mesh_, patch, [&](std::uint32_t j) {
        sum += known[j];
        ++count;
    });
    return count > 0 ? sum / count : known[patch];
}

/// Mixes weights: what is known counts as much as what was thought before; both have the same sum.
void RayWeights::mix(std::span<const double> known, std::span<const double> prior,
                     std::vector<double>& weights) {
    const double sum = std::accumulate(known.begin(), known.end(), 0.0);
    const double prior_sum = std::accumulate(prior.begin(), prior.end(), 0.0);
    if (!(sum > 0)) {
        weights.assign(prior.begin(), prior.end());
        return;
    }
    for (std::size_t i = 0; i < weights.size(); ++i)
        weights[i] = trust * known[i] * prior_sum / sum + (1 - trust) * prior[i];
}

/// Learns from the first rays. A ray is most important where it takes most from the error. A patch
/// counts by its area and its reflectance. The variance of random rays is the spread of the light
/// that comes from all sides, as far as it is known. Half of the weight does not trust that.
void RayWeights::learn(std::span<const Vec3> variance) {
    std::vector<double> known(variance.size()), smooth(variance.size());
    for (std::size_t i = 0; i < known.size(); ++i)
        known[i] =
            prior_random_[i] * std::sqrt(glm::dot(reflectance_[i] * reflectance_[i], variance[i]));
    for (std::uint32_t i = 0; i < known.size(); ++i)
        smooth[i] = prior_random_[i] > 0 ? of_neighbours(i, known) : 0;
    mix(smooth, prior_random_, learned_random_);
}

void RayWeights::weigh(std::span<const Vec3> variance, const std::vector<bool>& lit) {
    if (std::ranges::none_of(lit, std::identity{})) // nothing is known yet
        return;
    if (!has_learned_)
        learn(variance);
    has_learned_ = true;
    for (std::size_t i = 0; i < random_.size(); ++i)
        random_[i] = lit[i] ? learned_random_[i] : 0;
}

/// With a variance that falls as v n^-f, where f is variance_fall, the sum over patches is least
/// for n as v^(1 / (1 + f)). Here v is what one ray alone would leave.
void RayWeights::weigh_emitters(std::span<const double> variance,
                                std::span<const std::uint32_t> rays, const std::vector<bool>& lit) {
    if (std::ranges::none_of(lit, std::identity{}))
        return;
    std::vector<double> known(variance.size()), prior = prior_to_emitters_;
    for (std::size_t i = 0; i < known.size(); ++i) {
        if (variance[i] < 0)
            prior_to_emitters_[i] = prior[i] = 0;
        if (!lit[i])
            prior[i] = 0;
        if (prior[i] > 0)
            known[i] = elementary::pow(variance[i] * elementary::pow(rays[i], variance_fall),
                                       1 / (1 + variance_fall));
    }
    // A patch may have missed what its neighbours have found.
    std::vector<double> smooth(known.size());
    for (std::uint32_t i = 0; i < known.size(); ++i) {
        const double mean = of_neighbours(i, known);
        smooth[i] = prior[i] > 0 ? std::max(mean, .5 * (mean + known[i])) : 0;
    }
    mix(smooth, prior, to_emitters_);
}

/// Saves the weights; the rest follows from the scene.
void RayWeights::save(StateWriter& state) const {
    for (const std::vector<double>* weights : {&random_, &learned_random_, &to_emitters_})
        state.add(std::span<const double>(*weights));
    state.add(std::uint64_t{has_learned_});
}

void RayWeights::load(StateReader& state) {
    // Learning distributes the weights that the patches have by themselves, so their sum bounds
    // each.
    const auto sum_of = [](std::span<const double> prior) {
        constexpr double rounding = 1 + 1e-9;
        return rounding * std::accumulate(prior.begin(), prior.end(), 0.0);
    };
    state.get(std::span(random_), {0, sum_of(prior_random_)});
    state.get(std::span(learned_random_), {0, sum_of(prior_random_)});
    state.get(std::span(to_emitters_), {0, sum_of(prior_to_emitters_)});
    has_learned_ = state.flag();
}

} // namespace hemilux
