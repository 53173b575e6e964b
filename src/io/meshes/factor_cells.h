#pragma once
// Surfaces with the sums of their view factors, for ParaView and VTK.

#include "io/results/view_factor_files.h"

#include <cstdint>
#include <span>
#include <string>

namespace hemilux {

class Mesh;

/// Writes the facets as cells with `surface`, `area`, `sky`, `ground`, `back`, their standard
/// errors, `row_sum` and `unlisted_bound` of the surface that they belong to. Throws OutputError.
void write_factor_vtu(const std::string& path, const Mesh& mesh,
                      std::span<const std::uint32_t> row_of, const FactorTable& table);

} // namespace hemilux
