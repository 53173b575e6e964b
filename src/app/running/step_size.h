#pragma once
// --time holds within a step because a step is made small enough beforehand.

#include "app/settings/settings.h"

#include <cstddef>
#include <optional>

namespace hemilux {

/// Returns --rays, or fewer where a step of so many would take most of the time that there is. The
/// result depends on the numbers given alone, not on the machine.
[[nodiscard]] double rays_of_step(double rays, std::optional<double> seconds, const Method& method,
                                  std::size_t patches);
/// Logs a warning where `rays_of_step` is less than `rays`.
void log_rays_of_step(Verbosity verbosity, double rays, double rays_of_step);

} // namespace hemilux
