#pragma once
// The heat that grey surfaces exchange by radiation (Hottel and Sarofim 1967, the net radiation
// method), with the standard errors that those of the view factors give it.
//
// Surface i gives off J_i = emissivity_i sigma T_i^4 + (1 - emissivity_i) G_i, and its sides get
// G_i = sum_j F_ij J_j + sum_o F_io sigma T_o^4 with o the sky and the ground, which are black.
// Heat that it gives off is J_i - G_i. Of each surface the temperature is known, or that heat.
// Temperature and light are the same all over a surface.
//
// Rows of view factors sum to 1, so the heat between i and j is A_i F_ij (J_i - J_j), and an error
// of F_ij moves heat between these two alone. A sample of all errors moves the solution, by the
// same linear system; how such samples spread is the standard error.

#include "parallel/workers.h"
#include "radiosity/engine/factors/rows/view_factors.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hemilux {

/// The constant of Stefan and Boltzmann (CODATA 2018) [W/(m2 K4)].
inline constexpr double stefan_boltzmann = 5.670374419e-8;

/// What is known of a grey surface.
struct GreySurface {
    double emissivity = 1;             ///< [-], from 0 to 1
    std::optional<double> temperature; ///< [K]; without one `flux` is known
    double flux = 0;                   ///< heat that it gives off [W/m2]; 0 where emissivity is
};

/// A number and its standard error.
struct HeatEstimate {
    double value = 0, error = 0;
};

struct SurfaceHeat {
    /// [K]. NaN where nothing says it, also where emissivity is 0, or no temperature is low enough
    /// to take up the flux that is known.
    HeatEstimate temperature;
    HeatEstimate irradiation; ///< what arrives, G [W/m2]
    HeatEstimate flux;        ///< heat that it gives off [W/m2]
};

struct HeatExchange {
    std::vector<SurfaceHeat> surfaces; ///< by row of the view factors
    /// Heat that sky and ground give to the surfaces, and backs 0 [W/m2 times the unit of area of
    /// the factors].
    std::array<HeatEstimate, opens> open;
    /// Whether the iterations have solved it. If they ended at their limit, all errors are NaN.
    bool is_solved = true;
};

struct HeatOptions {
    /// Temperatures of sky, ground and backs [K]. What sees one without a temperature exchanges
    /// nothing with it.
    std::array<std::optional<double>, opens> open;
    std::uint64_t seed = 1; ///< of the errors' samples
    int max_iterations = 10'000;
};

/// Returns by row whether anything fixes how warm it is: its own temperature, that of the sky or
/// the ground that it sees, or that of a surface with which it exchanges heat, also by way of
/// others.
[[nodiscard]] std::vector<bool> are_fixed(const ViewFactors& factors,
                                          std::span<const GreySurface> surfaces,
                                          const HeatOptions& options);

/// Solves for all surfaces; those that nothing fixes have NaN. The result has the same bytes for
/// any number of threads.
[[nodiscard]] HeatExchange exchange_heat(const ViewFactors& factors,
                                         std::span<const GreySurface> surfaces,
                                         const HeatOptions& options, const Workers& workers);

} // namespace hemilux
