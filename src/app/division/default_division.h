#pragma once
// What a run does where nothing was said: whether it divides patches, how far, and when it ends.

#include "app/settings/settings.h"
#include "radiosity/light/division/adaptive_division.h"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace hemilux {

/// The most patches that a division makes where it was not asked for: some hundred megabytes, some
/// seconds. Models that have as many are not divided.
inline constexpr std::size_t max_patches_by_default = 20'000;

/// Returns whether a plain run on so many patches divides them. It does where the method is the
/// standard one, what was asked for says nothing of patches or single steps, and a mesh is written,
/// which shows no more than its patches have.
[[nodiscard]] bool divides_by_default(const SolveSettings& settings, std::size_t patches);

/// Returns how patches are divided: to which error of the patches, and to how many.
[[nodiscard]] AdaptiveDivision division_of(const SolveSettings& settings, std::size_t patches);

/// Returns the number of rays at which a run to an error ends at the latest, if nothing else ends
/// it.
[[nodiscard]] std::uint64_t default_max_rays(std::size_t patches);

/// The time [s] after which a run ends that has learned nothing (StopRule::patience), if nothing
/// else ends it.
inline constexpr double default_patience = 60;

/// Returns when the run ends. `sampling` is the error that --divide auto leaves to the run, where
/// that is known.
[[nodiscard]] StopRule stop_rule(const SolveSettings& settings, std::size_t patches,
                                 std::optional<double> sampling = {});

} // namespace hemilux
