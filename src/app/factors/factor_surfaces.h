#pragma once
// The rows of a matrix of view factors: which patch belongs to which, and what they are called.

#include "app/settings/view_factor_settings.h"
#include "io/results/view_factor_files.h"

#include <cstdint>
#include <string>
#include <vector>

namespace hemilux {

struct FactorSurfaces {
    std::vector<std::uint32_t> row_of; ///< by patch
    std::vector<FactorSurface> rows;

    /// Returns the row of this name, which --of pair has. Throws UsageError where there is none.
    [[nodiscard]] std::uint32_t row_named(const std::string& name) const;
};

/// Makes a row for each side of a face that has patches, in the order of the file, front first, or
/// for each group or material in use, or for each patch. A face is named by its number in the file,
/// from 0, with `back` after it where its back is meant, and a patch by its number in all tables.
[[nodiscard]] FactorSurfaces factor_surfaces(const Mesh& mesh, FactorRows by);

} // namespace hemilux
