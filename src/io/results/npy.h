#pragma once
// Dense matrices as NumPy arrays: format version 1.0, float64, little endian, C order (NumPy
// Enhancement Proposal 1).

#include "radiosity/form_factors/sampled_form_factors.h"

#include <atomic>
#include <string>

namespace hemilux {

/// Writes a square matrix; entries that are not stored are 0. Throws OutputError.
void write_npy(const std::string& path, const SparseMatrix& matrix,
               const std::atomic<bool>* interrupted = nullptr);

} // namespace hemilux
