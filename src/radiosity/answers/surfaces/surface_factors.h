#pragma once
// Computes view factors to the error that was asked for, whichever factors it is of.

#include "bvh/wide/wide_bvh.h"
#include "radiosity/answers/surfaces/surface_rows.h"
#include "radiosity/engine/factors/points/point_factors.h"
#include "radiosity/engine/factors/rows/sky_bands.h"
#include "radiosity/engine/factors/rows/view_factors.h"

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;
struct Monitor;

/// What factors are computed of.
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

/// Returns the parts of the sky that are asked for, if any.
[[nodiscard]] std::optional<SkyBands> bands_of(const std::optional<SkyDivision>& division, int up);

/// The largest factor of each row: the smallest of all, and the worst relative error.
struct LargestFactors {
    double smallest = 1, worst_error = 0;
};
[[nodiscard]] LargestFactors largest_factors(const ViewFactors& factors);

/// Computes the factors that are asked for. With `largest` it does so again where the largest
/// factor of a row is smaller than was thought. After an interrupt, factors are as exact as they
/// are then; there are no rows if it came before any was known. Throws std::invalid_argument for a
/// pair of which one is no surface.
[[nodiscard]] ViewFactors compute_factors(const FactorsAsked& asked, const FactorScene& scene,
                                          Monitor& monitor);

/// Computes the rows of points by error, rays, seed and threads that are asked for; an interrupt
/// leaves rows unknown.
[[nodiscard]] std::vector<PointFactors> compute_points(const FactorsAsked& asked,
                                                       const FactorScene& scene,
                                                       std::span<const FactorPoint> points,
                                                       Monitor& monitor);

} // namespace hemilux
