#pragma once
// A solution as part of a solver's state.

#include "radiosity/solution.h"

namespace hemilux {

class StateReader;
class StateWriter;

void save_energy(const EnergyBalance& energy, StateWriter& state);
void load_energy(EnergyBalance& energy, StateReader& state);

/// All that shows of a solution but densities, which methods that have none need not keep.
void save_solution(const Solution& solution, StateWriter& state);
/// Into a solution of as many patches. Throws StateError for anything else.
void load_solution(Solution& solution, StateReader& state);

} // namespace hemilux
