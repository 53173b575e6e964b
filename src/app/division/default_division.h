#pragma once
// What a run does of which nothing was said: whether it divides patches, how far, and how many rays
// it takes at the most.

#include "app/settings/settings.h"
#include "radiosity/division/adaptive_division.h"

#include <cstddef>
#include <cstdint>

namespace hemilux {

/// Where division was not asked for it makes so many patches at the most: some hundred megabytes,
/// some seconds. Models that have as many are large.
inline constexpr std::size_t most_patches_by_default = 20'000;
/// Large models are divided only where gathered light would be wrong by more than this, and to this
/// error.
inline constexpr double error_of_large_models = .05;

/// Whether a plain run on so many patches divides them: where the method is the standard one, and
/// what was asked for says nothing of patches or single steps.
[[nodiscard]] bool divides_by_default(const SolveSettings& settings, std::size_t patches);

/// Whether the patches of such a run are those of a large model.
[[nodiscard]] bool is_large_by_default(const SolveSettings& settings, std::size_t patches);

/// How patches are divided: to an error of the patches, and to how many.
[[nodiscard]] AdaptiveDivision division_of(const SolveSettings& settings, std::size_t patches);

/// A run to an error ends at a number of rays at the latest, if nothing else ends it.
[[nodiscard]] std::uint64_t default_max_rays(std::size_t patches);

} // namespace hemilux
