#pragma once
// Measures how well a matrix of form factors obeys what all form factors obey.

#include "radiosity/engine/factors/rows/escape_fraction.h"
#include "radiosity/engine/sparse/sparse_matrix.h"

#include <cstdint>
#include <span>

namespace hemilux {

class Mesh;

/// Factors and what follows from them have no unit [-].
struct MatrixQuality {
    std::uint64_t entries = 0;  ///< entries above 0
    double least = 0, most = 0; ///< bounds of these
    double closure_mean = 0;    ///< mean of |row sum - 1 + lost|
    double closure_most = 0;
    double lost_mean = 0; ///< share of rays that met no patch
    /// The sum of |A_i F_ij - A_j F_ji| over the sum of both terms.
    double reciprocity_mean = 0;
    /// The largest |A_i F_ij - A_j F_ji| / max(A_i, A_j): an error of the smaller factor.
    double reciprocity_most = 0;
};

/// Assesses a matrix; `lost` is given by row.
[[nodiscard]] MatrixQuality assess_matrix(const SparseMatrix& matrix, const Mesh& mesh,
                                          std::span<const EscapeFraction> lost);

} // namespace hemilux
