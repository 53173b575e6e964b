#include "radiosity/engine/stored_transport/step_errors.h"

#include "radiosity/engine/emitters/direct_light.h"
#include "radiosity/engine/saving/state.h"
#include "radiosity/engine/solving/transport_figures.h"
#include "radiosity/engine/stored_transport/batch_light.h"
#include "radiosity/engine/stored_transport/importance.h"
#include "radiosity/engine/stored_transport/stored_rays.h"
#include "radiosity/engine/stored_transport/transport_system.h"
#include "radiosity/paper/scene/needs.h"
#include "radiosity/paper/solution/error_spread.h"

#include <algorithm>
#include <array>
#include <utility>

namespace hemilux {
namespace {

constexpr unsigned batches = BatchLight::batches;
constexpr std::size_t patches_per_chunk = 512;

/// Sums over some patches.
struct Sums {
    std::array<double, batches * batches> products{}; ///< products of deviations
    double direct_variance = 0;
};

/// Adds the products of a patch's deviations from the mean of the batches.
void add_products(const TransportResult& result, std::uint32_t i, Sums& sums) {
    const Vec3 rho = result.system.reflectance()[i];
    const auto off = result.light.deviations(i);
    const Vec3 weight = weighted_area(result, i) * rho * rho;
    for (std::size_t s = 0; s < batches; ++s)
        for (std::size_t t = 0; t < batches; ++t)
            sums.products[s * batches + t] += glm::dot(weight * off[s], off[t]);
}

/// Returns the variance of the light that shadow rays bring to a patch.
double direct_variance(const TransportResult& result, std::uint32_t i) {
    const Vec3 rho = result.system.reflectance()[i], mean = result.direct.irradiance(i);
    Vec3 squares(0.0);
    for (std::size_t s = 0; s < batches; ++s) {
        const Vec3 off = result.direct.irradiance(i, s) - mean;
        squares += off * off;
    }
    return result.system.area()[i] * glm::dot(rho * rho, squares) / double(batches * (batches - 1));
}

} // namespace

BatchSpread spread_of_batches(const TransportResult& result, const TargetAim& aim,
                              const Workers& workers) {
    const std::size_t n = result.system.area().size();
    BatchSpread spread;
    spread.direct_variances.resize(n);
    std::vector<Sums> parts((n + patches_per_chunk - 1) / patches_per_chunk);
    workers.for_chunks(n, patches_per_chunk, [&](std::size_t begin, std::size_t end) {
        Sums& part = parts[begin / patches_per_chunk];
        for (auto i = static_cast<std::uint32_t>(begin); i < end; ++i) {
            add_products(result, i, part);
            const double variance = direct_variance(result, i);
            part.direct_variance += (aim.has_target() ? aim.counts_alone(i) : 1) * variance /
                                    result.light.generations();
            spread.direct_variances[i] = result.direct.samples(i) == 0 ? -1 : variance;
        }
    });
    Sums all;
    for (const Sums& part : parts) {
        for (std::size_t k = 0; k < all.products.size(); ++k)
            all.products[k] += part.products[k];
        all.direct_variance += part.direct_variance;
    }
    spread.freedom = effective_freedom(all.products, batches);
    spread.direct_variance = all.direct_variance;
    return spread;
}

StepErrors::StepErrors(const TransportErrors& errors, const BatchSpread& spread)
    : from_emitters(spread.direct_variance + errors.missed_by_shadow_rays),
      missed_in_dark(errors.missed_in_dark) {
    variance = std::max(errors.variance + errors.missed - missed_in_dark, from_emitters);
}

double StepErrors::relative(const Mesh& mesh, Solution& solution) const {
    const double all = std::exchange(solution.missed, solution.missed - missed_in_dark);
    const double error = estimated_error(mesh, solution);
    solution.missed = all;
    return error;
}

void StepErrors::save(StateWriter& state) const {
    state.add(variance);
    state.add(from_emitters);
    state.add(missed_in_dark);
}

void StepErrors::load(StateReader& state) {
    state.get(variance, bounds::non_negative);
    state.get(from_emitters, bounds::non_negative);
    state.get(missed_in_dark, bounds::non_negative);
}

void report(const TransportErrors& errors, const BatchSpread& spread, const Needs& needs,
            Solution& solution) {
    solution.standard_error = errors.standard_error;
    solution.variance = errors.variance;
    solution.variance_of_level = errors.of_losses;
    solution.missed = errors.missed + errors.missed_by_shadow_rays;
    solution.error_batches = batches;
    solution.effective_freedom = believed_freedom(solution.effective_freedom, spread.freedom);
    std::uint64_t unlit = 0;
    for (std::uint32_t i = 0; i < errors.needs_rays.size(); ++i)
        unlit += !errors.needs_rays[i] && needs.power(i);
    solution.figures.set(transport_figures::unlit, unlit);
}

} // namespace hemilux
