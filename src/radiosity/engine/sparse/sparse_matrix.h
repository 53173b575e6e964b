#pragma once
// A sparse matrix of form factors, by rows: what `matrix` solves with, and what files hold.

#include "parallel/workers.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

/// A sparse matrix by rows; the entries of a row are in any order, each column once [-]. The
/// reference is solved to a residual of 1e-12 and written to files. So its values are doubles, and
/// what two patches saw of each other is merged. Stored transport has rows of floats without
/// merging (sparse_rows.h): its rays err more than floats round.
struct SparseMatrix {
    std::vector<std::size_t> row_begin; ///< one more than rows
    std::vector<std::uint32_t> column;
    std::vector<double> value; ///< F [-]

    [[nodiscard]] std::size_t rows() const { return row_begin.size() - 1; }
    /// Computes y = M x.
    void multiply(std::span<const double> x, std::span<double> y, const Workers& workers) const;
};

} // namespace hemilux
