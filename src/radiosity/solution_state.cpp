#include "radiosity/solution_state.h"

#include "radiosity/state.h"

namespace hemilux {

void save_energy(const EnergyBalance& energy, StateWriter& state) {
    for (const Vec3& power : {energy.emitted, energy.absorbed, energy.escaped, energy.unshot})
        state.add(power);
}

void load_energy(EnergyBalance& energy, StateReader& state) {
    for (Vec3* power : {&energy.emitted, &energy.absorbed, &energy.escaped, &energy.unshot})
        state.get(*power);
}

void save_solution(const Solution& solution, StateWriter& state) {
    state.add(solution.steps);
    state.add(solution.rays_energy);
    state.add(solution.bytes_transport);
    state.add(solution.error_samples);
    state.add(solution.error_parts.value_or(0));
    state.add(solution.variance.value_or(-1));
    state.add(solution.variance_of_level);
    state.add(solution.unseen);
    state.add(std::uint64_t{solution.unlit});
    save_energy(solution.energy, state);
    state.add(std::span<const Vec3>(solution.radiosity));
    state.add(std::span<const Vec3>(solution.standard_error));
    state.add(std::span<const std::uint64_t>(solution.hits));
}

void load_solution(Solution& solution, StateReader& state) {
    state.get(solution.steps);
    state.get(solution.rays_energy);
    state.get(solution.bytes_transport);
    state.get(solution.error_samples);
    const double parts = state.number();
    solution.error_parts = parts > 0 ? std::optional(parts) : std::nullopt;
    const double variance = state.number();
    solution.variance = variance >= 0 ? std::optional(variance) : std::nullopt;
    state.get(solution.variance_of_level);
    state.get(solution.unseen);
    solution.unlit = state.whole();
    load_energy(solution.energy, state);
    state.get(std::span(solution.radiosity));
    state.get(std::span(solution.standard_error));
    state.get(std::span(solution.hits));
}

} // namespace hemilux
