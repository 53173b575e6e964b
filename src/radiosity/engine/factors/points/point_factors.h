#pragma once
// View factors from points with a normal: the factor from an infinitesimal facet there to every
// surface, to sky, ground and backs.
//
// From a point, what hides a polygon is a cone of directions. So the part that is seen is cut out
// exactly (seen_part.h), and its factor has the closed form of Lambert (1760): the sum over edges
// of angle times cosine. Where too much lies in between, the free factor is multiplied by the share
// of rays that arrive. Sky and ground are what all surfaces together leave of the hemisphere.

#include "bvh/wide/wide_bvh.h"
#include "parallel/workers.h"
#include "radiosity/engine/factors/rows/open_share.h"

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;
class SkyBands;
struct Monitor;

/// A point in the local frame.
struct FactorPoint {
    Vec3 position;
    Vec3 normal;                ///< unit
    std::uint32_t facet = none; ///< facet that it lies on, which hides nothing from it
};

/// The row of a point. Its factors and what is open sum to 1.
struct PointFactors {
    bool is_known = false;              ///< false: the run was interrupted before
    std::vector<std::uint32_t> column;  ///< surfaces, ascending
    std::vector<double> factor;         ///< [-]
    std::vector<double> standard_error; ///< [-]; 0: it is exact
    std::array<OpenShare, opens> open;
    std::vector<OpenShare> bands; ///< of the sky, if they are asked for: they sum to it
    /// A bound of the sum of factors that are not listed [-]: facets that are too small to count
    /// and that no ray hit. In 95 of 100 rows it holds.
    double unlisted_bound = 0;

    /// Returns the sum with what is open [-].
    [[nodiscard]] double sum() const;
};

struct PointFactorOptions {
    double error = .01, least = 1e-3; ///< relative error of factors above `least` [-]
    std::uint32_t rays = 1024;        ///< from a point, that look for small facets; a power of two
    std::uint64_t seed = 1;
    int up = 2;                      ///< axis that points to the sky
    const SkyBands* bands = nullptr; ///< parts of the sky, which rays find
    /// Is called as rows are found, from all threads, with the bytes of those found so far. What it
    /// throws ends the work.
    std::function<void(double bytes)> ask = {};
};

/// Finds the rows of all points. row_of[patch] says to which surface a patch belongs. The result
/// has the same bytes for any number of threads. An interrupt leaves rows unknown.
[[nodiscard]] std::vector<PointFactors> point_factors(std::span<const FactorPoint> points,
                                                      const Mesh& mesh, const WideBvh& tree,
                                                      std::span<const std::uint32_t> row_of,
                                                      const PointFactorOptions& options,
                                                      const Workers& workers, Monitor& monitor);

} // namespace hemilux
