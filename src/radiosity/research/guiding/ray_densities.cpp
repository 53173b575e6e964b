#include "radiosity/research/guiding/ray_densities.h"

#include "radiosity/engine/saving/state.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

namespace hemilux {
namespace {

/// The largest density: it stays within what floats hold, whatever the areas.
constexpr double max_density = 1e12;

} // namespace

RayDensities::RayDensities(std::size_t patches, std::vector<double> shares)
    : shares_(std::move(shares)), importance_(patches * shares_.size(), log_byte::from(1)),
      rays_for_power_(patches, 1) {
    density_.fill(1);
}

double RayDensities::keep(std::uint32_t patch, std::size_t leaf, double root) {
    std::uint8_t& byte = importance_[patch * leaves() + leaf];
    byte = log_byte::from(root);
    return log_byte::value(byte);
}

void RayDensities::set_mean(double mean_root) {
    mean_root_ = mean_root;
    for (std::size_t byte = 0; byte < log_byte::values; ++byte) {
        const double guided = mean_root > 0 ? log_byte::value(byte) / mean_root : 1;
        density_[byte] = lowest_density + (1 - lowest_density) * std::min(guided, max_density);
    }
}

void RayDensities::find_for_power(std::uint32_t patch) {
    double rays = 0;
    for (std::size_t t = 0; t < leaves(); ++t)
        rays += shares_[t] * of(patch, t);
    rays_for_power_[patch] = rays;
}

void RayDensities::save(StateWriter& state) const {
    state.add(mean_root_);
    state.add(
        std::string_view(reinterpret_cast<const char*>(importance_.data()), importance_.size()));
}

void RayDensities::load(StateReader& state) {
    const double mean_root = state.number(bounds::non_negative);
    const std::string importance = state.text();
    if (importance.size() != importance_.size())
        throw StateError("the number of triangles is not that of the patches");
    std::ranges::copy(importance, importance_.begin());
    set_mean(mean_root);
}

} // namespace hemilux
