#pragma once
// Saves and loads a solution as part of a solver's state.

#include "radiosity/paper/solution/solution.h"

#include <span>

namespace hemilux {

class StateReader;
class StateWriter;

/// Loads the light of the patches [W/m2], which is at most `most`. The iterations of a method may
/// leave it a little below 0. Throws StateError if it is larger, or far below 0.
void load_light(std::span<Vec3> light, double most, StateReader& state);

void save_energy(const EnergyBalance& energy, StateWriter& state);
/// Loads a balance; throws StateError for what is not finite.
void load_energy(EnergyBalance& energy, StateReader& state);

/// Saves all of a solution that is reported, but no densities.
void save_solution(const Solution& solution, StateWriter& state);
/// Loads into a solution of as many patches. Throws StateError for anything else.
void load_solution(Solution& solution, StateReader& state);

} // namespace hemilux
