#include "radiosity/engine/sparse/sparse_matrix.h"

namespace hemilux {

void SparseMatrix::multiply(std::span<const double> x, std::span<double> y,
                            const Workers& workers) const {
    workers.for_chunks(rows(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            double sum = 0;
            for (std::size_t k = row_begin[i]; k < row_begin[i + 1]; ++k)
                sum += value[k] * x[column[k]];
            y[i] = sum;
        }
    });
}

} // namespace hemilux
