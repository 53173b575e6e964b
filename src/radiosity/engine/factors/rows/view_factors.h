#pragma once
// View factors between surfaces, each with its standard error: the patches' factors, closed and
// summed over the surfaces that the patches belong to.

#include "radiosity/engine/factors/rows/closing.h"
#include "radiosity/engine/factors/rows/find_exchange.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

/// A matrix of compressed sparse rows. Entries of a row are ascending by column. Rows sum to 1 with
/// what is open, and area_i F_ij = area_j F_ji. The diagonal holds what a surface of several
/// patches sees of itself.
struct ViewFactors {
    std::vector<std::size_t> row_begin; ///< one more than rows
    std::vector<std::uint32_t> column;
    std::vector<double> factor;         ///< [-]
    std::vector<double> standard_error; ///< [-]; 0: nothing lies between, it is exact

    std::vector<double> area; ///< by row, in the square of the unit of the mesh's local frame
    std::vector<std::array<OpenShare, opens>> open; ///< by row: sky, ground and backs
    std::vector<double> unlisted_bound;             ///< by row: ExchangeList
    std::vector<OpenShare> bands; ///< of the sky, by row and band: they sum to it; or empty
    ClosingAudit audit;           ///< of the patches
    ExchangeWork work;

    [[nodiscard]] std::size_t rows() const { return area.size(); }
    /// Returns the place of an entry, or the number of entries where there is none.
    [[nodiscard]] std::size_t place(std::uint32_t row, std::uint32_t of_column) const;
    /// Returns F [-] and its standard error; both 0 where the pair is not listed.
    [[nodiscard]] OpenShare between(std::uint32_t from, std::uint32_t to) const;
    /// Returns the parts of the sky of a row.
    [[nodiscard]] std::span<const OpenShare> bands_of(std::uint32_t row) const {
        const std::size_t count = bands.size() / std::max<std::size_t>(rows(), 1);
        return std::span(bands).subspan(row * count, count);
    }
    /// Returns the sum of a row with what is open [-].
    [[nodiscard]] double row_sum(std::uint32_t row) const;
};

/// Computes the factors between `rows` surfaces; row_of[patch] says to which a patch belongs. The
/// result has no rows where find_exchange() returns a void one.
[[nodiscard]] ViewFactors view_factors(const Mesh& mesh, const WideBvh& tree,
                                       std::span<const std::uint32_t> row_of, std::size_t rows,
                                       const ExchangeOptions& options, const Workers& workers,
                                       Monitor& monitor);

/// Sums the exchange of patches over surfaces, and frees it as it does so.
[[nodiscard]] ViewFactors sum_over_rows(ExchangeList list, std::span<const std::uint32_t> row_of,
                                        std::size_t rows);

/// The errors of factors of at least a size, from either side of a pair.
struct FactorErrors {
    std::uint64_t factors = 0;
    double rms = 0, worst = 0; ///< of standard errors, relative [-]
};
[[nodiscard]] FactorErrors errors_above(const ViewFactors& factors, double least);

/// Returns the largest |A_i F_ij / (A_j F_ji) - 1| of all pairs, as uDALES checks it [-].
[[nodiscard]] double worst_reciprocity(const ViewFactors& factors);

} // namespace hemilux
