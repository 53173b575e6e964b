#pragma once
// What `exchange` reads and writes: what is known of the surfaces, and the heat that they exchange.

#include "app/settings/view_factor_settings.h"
#include "radiosity/answers/surfaces/surface_factors.h"
#include "radiosity/engine/heat/heat_exchange.h"

#include <span>
#include <string>
#include <vector>

namespace hemilux {

/// Reads a table with the columns surface, emissivity, temperature [K] and flux [W/m2], one of the
/// last two for each row. `*` in the name of a surface stands for any letters; of rows that match a
/// surface the last counts. Throws InputError where a surface is missing or not one of the rows.
[[nodiscard]] std::vector<GreySurface> read_grey_surfaces(const std::string& path,
                                                          const FactorSurfaces& surfaces);

/// Looks before the work whether enough is known. Throws UsageError where some surfaces see the sky
/// or the ground and nothing says how warm it is, InputError where no surface has a temperature.
void check_temperatures(const ViewFactorSettings& settings, const FactorScene& scene,
                        std::span<const GreySurface> grey);

/// Computes the heat, writes its table and logs how exact it is.
void write_heat(const ViewFactorSettings& settings, const FactorSurfaces& surfaces,
                std::span<const GreySurface> grey, const ViewFactors& factors,
                double world_area_of_unit);

} // namespace hemilux
