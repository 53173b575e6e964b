#pragma once
// A sparse matrix of form factors as a file.

#include "radiosity/engine/sparse/sparse_matrix.h"

#include <atomic>
#include <string>

namespace hemilux {

/// Writes CSV: `i,j,F`, a row per factor above 0. Numbers are the shortest text that gives back the
/// same double. Throws OutputError.
void write_factor_table(const std::string& path, const SparseMatrix& matrix,
                        const std::atomic<bool>* interrupted = nullptr);

/// Writes a square matrix as a dense NumPy array: format version 1.0, float64, little endian, C
/// order (NumPy Enhancement Proposal 1). Entries that are not stored are 0. Throws OutputError.
void write_npy(const std::string& path, const SparseMatrix& matrix,
               const std::atomic<bool>* interrupted = nullptr);

} // namespace hemilux
