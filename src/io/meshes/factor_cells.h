#pragma once
// Surfaces with the sums of their view factors, for ParaView and VTK.

#include "io/results/view_factor_files.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace hemilux {

class Mesh;

/// Writes the facets as cells with `surface`, `area`, `sky`, `ground`, `back`, bands of the sky,
/// their standard errors, `row_sum` and `unlisted_bound` of the surface that they belong to. Points
/// that have rows follow as vertices. `sunlit` has the sunlit fractions by sun, those of surfaces
/// before those of points: an array each, which counts suns where there are several. What is not
/// known of a cell is NaN. Throws OutputError.
void write_factor_vtu(const std::string& path, const Mesh& mesh,
                      std::span<const std::uint32_t> row_of, const FactorTable& table,
                      std::span<const std::vector<OpenShare>> sunlit);

} // namespace hemilux
