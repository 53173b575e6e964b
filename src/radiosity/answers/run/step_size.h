#pragma once
// A limit of time holds within a step because a step is made small enough beforehand.

#include "radiosity/answers/asked/finding.h"
#include "radiosity/engine/solving/method.h"

#include <cstddef>
#include <optional>

namespace hemilux {

/// Returns the mean rays of a patch in a step as asked for, or fewer where a step of so many would
/// take most of the time that there is. The result depends on the numbers given alone, not on the
/// machine.
[[nodiscard]] double rays_of_step(double rays, std::optional<double> seconds, const Method& method,
                                  std::size_t patches);
/// Returns a warning where a step takes fewer rays than were asked for.
[[nodiscard]] std::optional<Finding> smaller_step_finding(double asked, double taken);

} // namespace hemilux
