#pragma once
// The rows of a matrix of view factors: which patch belongs to which, and what they are called.

#include "geometry/vector.h"
#include "radiosity/answers/surfaces/factors_asked.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hemilux {

class Mesh;

/// A row as the user knows it.
struct FactorSurface {
    std::string name;
    std::string face, side, material, group; ///< those that all its patches share, or empty
    double area = 0;                         ///< [m2]
    Vec3 centre{0.0};                        ///< centre of mass [m]
    Vec3 normal{0.0};                        ///< mean, unit; 0 where the sides cancel
};

/// A point that has a row, as the user knows it.
struct FactorPlace {
    std::string name;
    Vec3 position, normal; ///< as in the file [m], [-]
};

struct FactorSurfaces {
    std::vector<std::uint32_t> row_of; ///< by patch
    std::vector<FactorSurface> rows;

    /// Returns the row of this name, if there is one.
    [[nodiscard]] std::optional<std::uint32_t> row_named(const std::string& name) const;
};

/// Makes a row for each side of a face that has patches, in the order of the file, front first, or
/// for each group or material in use, or for each patch. A face is named by its number in the file,
/// from 0, with `back` after it where its back is meant, and a patch by its number in all tables.
[[nodiscard]] FactorSurfaces factor_surfaces(const Mesh& mesh, FactorRows by);

} // namespace hemilux
