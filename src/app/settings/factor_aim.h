#pragma once
// What the command line says about view factors: whose error is asked for, how the sky is
// divided, and kinds of files.

#include "app/settings/view_factor_settings.h"
#include "radiosity/answers/surfaces/surface_rows.h"

#include <optional>
#include <string>
#include <string_view>

namespace hemilux {

/// Reads "above:F", "rows", "largest", "pair:A,B" or "sky"; empty for any other text.
[[nodiscard]] std::optional<FactorAim> parse_factor_aim(std::string_view text);

/// Returns what parse_factor_aim() reads.
[[nodiscard]] std::string text_of(const FactorAim& aim);

/// Throws UsageError where the aim is a pair of which one is no surface.
void check_aim(const FactorAim& aim, const FactorSurfaces& surfaces);

/// Reads a number of bands from 1 to 90, or "tregenza"; empty for any other text.
[[nodiscard]] std::optional<SkyDivision> parse_sky_division(std::string_view text);

enum class FactorFile { pairs, sparse, dense, cells, udales_factors, udales_sky };

/// Returns the kind of a file by its extension, or by the beginning of its name; empty if it is
/// unknown.
[[nodiscard]] std::optional<FactorFile> factor_file_of(const std::string& path);

} // namespace hemilux
