#pragma once
// A sparse matrix of form factors as a file.

#include "radiosity/engine/sparse/sparse_matrix.h"

#include <atomic>
#include <cstddef>
#include <optional>
#include <string>

namespace hemilux {

/// Writes CSV: `i,j,F`, a row per factor above 0. Numbers are the shortest text that gives back the
/// same double. Throws OutputError.
void write_factor_table(const std::string& path, const SparseMatrix& matrix,
                        const std::atomic<bool>* interrupted = nullptr);

/// Returns the header of an .npy file of format version 1.0 (NumPy Enhancement Proposal 1) for
/// numbers of a type such as "<f8", in C order. It is padded so that they begin at a multiple of 64
/// bytes.
[[nodiscard]] std::string npy_header(const std::string& type, const std::string& shape);

/// Writes a matrix as a dense NumPy array: float64, little endian, C order. Entries that are not
/// stored are 0. Without `columns` it is square. Throws OutputError.
void write_npy(const std::string& path, const SparseMatrix& matrix,
               const std::atomic<bool>* interrupted = nullptr,
               std::optional<std::size_t> columns = {});

} // namespace hemilux
