#pragma once
// A solution as part of a solver's state.

#include "radiosity/solving/solution.h"

#include <span>

namespace hemilux {

class StateReader;
class StateWriter;

/// Light of the patches [W/m2] that no step may have made larger than `most`. The iterations of a
/// method may leave it a little below 0; StateError where it is far below.
void load_light(std::span<Vec3> light, double most, StateReader& state);

void save_energy(const EnergyBalance& energy, StateWriter& state);
/// Throws StateError for what is not finite.
void load_energy(EnergyBalance& energy, StateReader& state);

/// All that shows of a solution but densities, which methods that have none need not keep.
void save_solution(const Solution& solution, StateWriter& state);
/// Into a solution of as many patches. Throws StateError for anything else.
void load_solution(Solution& solution, StateReader& state);

} // namespace hemilux
