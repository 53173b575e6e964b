#include "radiosity/engine/saving/solution_state.h"

#include "radiosity/engine/saving/state.h"
#include "radiosity/engine/solving/transport_figures.h"
#include "radiosity/paper/solution/solve_error.h"

#include <algorithm>
#include <limits>

namespace hemilux {

namespace {

/// The light that an iteration may leave below 0, as a share of the largest of all patches.
constexpr double max_below = .1;

/// The bounds of a number that may be unknown; -1 stands for what is not known.
constexpr Bounds known_or_not{-1, bounds::largest};

std::optional<double> number_or_nothing(StateReader& state) {
    const double number = state.number(known_or_not);
    return number >= 0 ? std::optional(number) : std::nullopt;
}

} // namespace

void load_light(std::span<Vec3> light, double most, StateReader& state) {
    state.get(light, {-max_below * most, most});
    double largest = 0;
    for (const Vec3& each : light)
        largest = std::max({largest, each.x, each.y, each.z});
    for (const Vec3& each : light)
        if (std::min({each.x, each.y, each.z}) < -max_below * largest)
            throw StateError("a light in it is negative");
}

void save_energy(const EnergyBalance& energy, StateWriter& state) {
    for (const Vec3& power : {energy.emitted, energy.absorbed, energy.escaped, energy.unshot})
        state.add(power);
}

void load_energy(EnergyBalance& energy, StateReader& state) {
    for (Vec3* power : {&energy.emitted, &energy.absorbed, &energy.escaped, &energy.unshot})
        state.get(*power, bounds::finite);
}

void save_solution(const Solution& solution, StateWriter& state) {
    state.add(solution.steps);
    state.add(solution.rays_energy);
    state.add(solution.figures.value(transport_figures::bytes));
    state.add(solution.error_batches);
    state.add(solution.effective_freedom.value_or(0));
    state.add(solution.variance.value_or(-1));
    state.add(solution.variance_of_level);
    state.add(solution.missed);
    state.add(solution.figures.value(transport_figures::unlit));
    save_energy(solution.energy, state);
    state.add(std::span<const Vec3>(solution.radiosity));
    state.add(std::span<const Vec3>(solution.standard_error));
    state.add(std::span<const std::uint64_t>(solution.hits));
}

void load_solution(Solution& solution, StateReader& state) {
    state.get(solution.steps);
    state.get(solution.rays_energy);
    std::uint64_t bytes = 0;
    state.get(bytes);
    solution.figures.set(transport_figures::bytes, bytes);
    state.get(solution.error_batches, bounds::non_negative);
    const double parts = state.number({0, std::numeric_limits<double>::infinity()});
    solution.effective_freedom = parts > 0 ? std::optional(parts) : std::nullopt;
    solution.variance = number_or_nothing(state);
    state.get(solution.variance_of_level, bounds::non_negative);
    state.get(solution.missed, bounds::non_negative);
    solution.figures.set(transport_figures::unlit, state.whole_up_to(solution.radiosity.size()));
    load_energy(solution.energy, state);
    load_light(solution.radiosity, 2 * largest_radiosity, state);
    state.get(std::span(solution.standard_error), bounds::non_negative);
    state.get(std::span(solution.hits));
}

} // namespace hemilux
