#include "radiosity/gathering_plan.h"

#include "radiosity/mesh.h"
#include "radiosity/ray_deal.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hemilux {
namespace {

/// Rays per patch at which the run ends whatever the error.
constexpr double most_rays = 1u << 20;

/// A kind of ray whose error costs less than this share of the other's is not doubled. Errors of
/// well-distributed points fall about as rays^-3/4: doubling one kind takes two thirds of its
/// variance.
constexpr double worth_doubling = .35;

/// The share of the weights that is measured; and what a patch's area counts.
constexpr double trust = .5, area_exponent = .42;

/// Black emitters count as if they reflected this: their rays tell where their light goes.
constexpr double least_reflectance = .1;

double sum(const std::vector<std::uint32_t>& rays) {
    return std::accumulate(rays.begin(), rays.end(), 0.0);
}

} // namespace

GatheringPlan::GatheringPlan(const Mesh& mesh, const Needs& needs, double random, double to_lamps) {
    const auto patches = mesh.patches();
    first_.random = std::clamp(random, 1.0, most_rays);
    first_.to_lamps = to_lamps > 0 ? first_.random : 0;
    now_.rays.random.resize(patches.size());
    now_.rays.to_lamps.resize(patches.size());
    for (std::uint32_t i = 0; i < patches.size(); ++i) {
        reflectance_.push_back(mesh.material(i).reflectance);
        const double reflectance = glm::length(reflectance_[i]);
        const double area = needs.power(i) ? std::pow(patches[i].area, area_exponent) : 0;
        lamp_weights_.push_back(area * reflectance);
        prior_weights_.push_back(area * std::max(reflectance, least_reflectance));
    }
    weights_ = prior_weights_;
    some_without_ = to_lamps > 0 && std::ranges::count(lamp_weights_, 0.0) > 0;
}

void GatheringPlan::grow(double variance, double variance_of_lamps) {
    before_ = now_;
    if (now_.random > 0) {
        // What the next ray of either kind takes from the variance.
        choose((variance - variance_of_lamps) / now_.random,
               now_.to_lamps > 0 ? variance_of_lamps / now_.to_lamps : 0);
    } else {
        now_.random = first_.random;
        now_.to_lamps = first_.to_lamps;
    }
    now_.rays.random = deal_rays(weights_, now_.random, before_.rays.random);
    now_.rays.to_lamps = deal_rays(lamp_weights_, now_.to_lamps, before_.rays.to_lamps);
}

void GatheringPlan::choose(double of_random, double of_lamps) {
    const bool more_random = !(of_random < worth_doubling * of_lamps);
    if (!(of_lamps < worth_doubling * of_random) && now_.to_lamps > 0)
        now_.to_lamps *= 2;
    if (more_random)
        now_.random *= 2;
}

double GatheringPlan::growth() const {
    const double old = sum(before_.rays.random);
    return old > 0 ? sum(now_.rays.random) / old : 1;
}

bool GatheringPlan::at_most() const { return std::max(now_.random, now_.to_lamps) >= most_rays; }

/// A ray is worth most where it takes most from the error. A patch counts by its area and its
/// reflectance, and the variance of random rays is the spread of the light that comes from all
/// sides, as far as it is known; half of the weight does not trust that.
void GatheringPlan::weigh(const ExchangeMatrix& factors, std::span<const Vec3> light,
                          const Workers& workers) {
    const std::size_t n = light.size();
    std::vector<Vec3> squares(n), mean(n), mean_of_squares(n);
    for (std::size_t i = 0; i < n; ++i)
        squares[i] = light[i] * light[i];
    factors.multiply(light, mean, workers);
    factors.multiply(squares, mean_of_squares, workers);
    std::vector<double> spread(n);
    double sum = 0, sum_of_weights = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3 variance = glm::max(mean_of_squares[i] - mean[i] * mean[i], 0.0);
        spread[i] = std::sqrt(glm::dot(reflectance_[i] * reflectance_[i], variance));
        sum += prior_weights_[i] * spread[i];
        sum_of_weights += prior_weights_[i];
    }
    if (sum > 0)
        for (std::size_t i = 0; i < n; ++i)
            weights_[i] =
                prior_weights_[i] * (trust * spread[i] * sum_of_weights / sum + 1 - trust);
}

} // namespace hemilux
