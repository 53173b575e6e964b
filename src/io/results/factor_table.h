#pragma once
// A sparse matrix of form factors as CSV: `i,j,F`, a row per factor above 0.

#include "radiosity/form_factors/sampled_form_factors.h"

#include <atomic>
#include <string>

namespace hemilux {

/// Writes the table. Numbers are the shortest text that gives back the same double. Throws
/// OutputError.
void write_factor_table(const std::string& path, const SparseMatrix& matrix,
                        const std::atomic<bool>* interrupted = nullptr);

} // namespace hemilux
