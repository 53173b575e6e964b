#pragma once
// Checks of a sampling strategy, for one that somebody adds: what every strategy owes, whatever it
// guides its rays by.

#include "radiosity/engine/solving/method.h"

#include <string>
#include <vector>

namespace hemilux {

/// Returns what is wrong, a line each; empty where nothing was found. Checked are, on an open scene
/// and on rooms with corners and a block, for three depths of the hemisphere and several steps:
///
/// - shares of power and of rays sum to 1;
/// - each cell has the power of Lambert's law, and rays where it has power;
///
/// and for methods that declare themselves unbiased, by 64 steps with standard errors:
///
/// - in a closed room of one material that emits E and reflects rho, the light is E / (1 - rho);
/// - in a room with a block it is that of `matrix`.
///
/// The last two fail where light is off by 1.3 standard errors (RMS over patches), by 0.35 in the
/// mean, or by 7 at one patch. Throws std::invalid_argument where the method has no strategy.
[[nodiscard]] std::vector<std::string> check_strategy(const Method& method, unsigned threads = 0);

} // namespace hemilux
