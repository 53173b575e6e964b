#include "radiosity/engine/stored_transport/batch_light.h"

#include "radiosity/engine/saving/solution_state.h"
#include "radiosity/engine/saving/state.h"
#include "radiosity/paper/solution/solve_error.h"

#include <limits>

namespace hemilux {

EnergyBalance BatchLight::energy() const {
    const EnergyBalance& now = solved_[batches].energy;
    EnergyBalance sum = now;
    if (!before_.empty()) {
        sum.absorbed += before_[batches].energy.absorbed;
        sum.escaped += before_[batches].energy.escaped;
    }
    return {now.emitted, sum.absorbed / generations(), sum.escaped / generations(), Vec3(0.0)};
}

void BatchLight::begin_generation() {
    if (before_.empty())
        before_.resize(batches + 1, Light(solved_[0].incident.size()));
    for (std::size_t s = 0; s <= batches; ++s) {
        for (std::size_t i = 0; i < solved_[s].incident.size(); ++i)
            before_[s].incident[i] += solved_[s].incident[i];
        before_[s].energy.absorbed += solved_[s].energy.absorbed;
        before_[s].energy.escaped += solved_[s].energy.escaped;
    }
    ++generation_;
}

void BatchLight::save(StateWriter& state) const {
    state.add(generation_);
    for (const std::vector<Light>* lights : {&solved_, &before_})
        for (const Light& light : *lights) {
            state.add(std::span<const Vec3>(light.incident));
            save_energy(light.energy, state);
        }
}

void BatchLight::load(StateReader& state) {
    generation_ = state.whole_up_to(std::numeric_limits<std::uint32_t>::max());
    before_.resize(generation_ > 0 ? batches + 1 : 0, Light(solved_[0].incident.size()));
    for (std::vector<Light>* lights : {&solved_, &before_})
        for (Light& light : *lights) {
            load_light(light.incident, generations() * largest_radiosity, state);
            load_energy(light.energy, state);
        }
}

} // namespace hemilux
