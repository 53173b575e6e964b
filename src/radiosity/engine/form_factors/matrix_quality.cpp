#include "radiosity/engine/form_factors/matrix_quality.h"

#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cmath>

namespace hemilux {

namespace {

/// Returns F_ij; columns of a row ascend.
double entry(const SparseMatrix& matrix, std::uint32_t i, std::uint32_t j) {
    const auto begin = matrix.column.begin() + static_cast<std::ptrdiff_t>(matrix.row_begin[i]);
    const auto end = matrix.column.begin() + static_cast<std::ptrdiff_t>(matrix.row_begin[i + 1]);
    const auto found = std::lower_bound(begin, end, j);
    return found != end && *found == j
               ? matrix.value[static_cast<std::size_t>(found - matrix.column.begin())]
               : 0.0;
}

void assess_rows(const SparseMatrix& matrix, std::span<const EscapeFraction> lost,
                 MatrixQuality& quality) {
    const auto rows = static_cast<std::uint32_t>(matrix.rows());
    for (std::uint32_t i = 0; i < rows; ++i) {
        double sum = 0;
        for (std::size_t k = matrix.row_begin[i]; k < matrix.row_begin[i + 1]; ++k) {
            const double f = matrix.value[k];
            sum += f;
            if (!(f > 0))
                continue;
            quality.least = quality.entries == 0 ? f : std::min(quality.least, f);
            quality.most = std::max(quality.most, f);
            ++quality.entries;
        }
        const double elsewhere = lost[i].sum();
        const double closure = std::abs(sum - 1 + elsewhere);
        quality.closure_mean += closure / rows;
        quality.closure_most = std::max(quality.closure_most, closure);
        quality.lost_mean += elsewhere / rows;
    }
}

void assess_pairs(const SparseMatrix& matrix, const Mesh& mesh, MatrixQuality& quality) {
    const auto patches = mesh.patches();
    double difference = 0, whole = 0;
    for (std::uint32_t i = 0; i < patches.size(); ++i)
        for (std::size_t k = matrix.row_begin[i]; k < matrix.row_begin[i + 1]; ++k) {
            const std::uint32_t j = matrix.column[k];
            const double there = patches[i].area * matrix.value[k];
            const double back = patches[j].area * entry(matrix, j, i);
            difference += std::abs(there - back);
            whole += there + back;
            quality.reciprocity_most =
                std::max(quality.reciprocity_most,
                         std::abs(there - back) / std::max(patches[i].area, patches[j].area));
        }
    quality.reciprocity_mean = whole > 0 ? difference / whole : 0;
}

} // namespace

MatrixQuality assess_matrix(const SparseMatrix& matrix, const Mesh& mesh,
                            std::span<const EscapeFraction> lost) {
    MatrixQuality quality;
    assess_rows(matrix, lost, quality);
    assess_pairs(matrix, mesh, quality);
    return quality;
}

} // namespace hemilux
