#pragma once
// Computes view factors to the error that was asked for, whichever factors it is of.

#include "app/factors/factor_surfaces.h"
#include "bvh/wide/wide_bvh.h"
#include "radiosity/engine/factors/points/point_factors.h"
#include "radiosity/engine/factors/rows/sky_bands.h"
#include "radiosity/engine/factors/rows/view_factors.h"

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace hemilux {

/// What factors are computed of; all of it but the values outlives the run.
struct FactorScene {
    const Mesh& mesh;
    const WideBvh& tree; ///< tree of the mesh
    const FactorSurfaces& surfaces;
    int up;                                     ///< axis that points to the sky
    std::function<void(double bytes)> ask = {}; ///< ExchangeOptions::ask
    const SkyBands* bands = nullptr;            ///< parts of the sky, if they are asked for
    std::function<void(std::span<MeasuredRow>)> load = {}; ///< ExchangeOptions::load, keep
    std::function<void(std::span<const MeasuredRow>, bool is_last)> keep = {};
};

/// Returns the parts of the sky that the settings ask for, if any.
[[nodiscard]] std::optional<SkyBands> bands_of(const ViewFactorSettings& settings, int up);

/// Computes the factors by `error`, `aim`, `rays`, seed, threads and time of the settings. With
/// `largest` it does so again where the largest factor of a row is smaller than was thought. After
/// an interrupt, factors are as exact as they are then; there are no rows if it came before any was
/// known. Throws UsageError for a pair of which one has no surface.
[[nodiscard]] ViewFactors compute_factors(const ViewFactorSettings& settings,
                                          const FactorScene& scene, Monitor& monitor);

/// Computes the rows of points by `error`, `rays`, seed and threads of the settings; an interrupt
/// leaves rows unknown.
[[nodiscard]] std::vector<PointFactors> compute_points(const ViewFactorSettings& settings,
                                                       const FactorScene& scene,
                                                       std::span<const FactorPoint> points,
                                                       Monitor& monitor);

} // namespace hemilux
