#pragma once
// Holds what all patches exchange with each other, from the rays of all.
//
// S_ij = A_i F_ij is symmetric, so rays from i to j and from j to i estimate the same number.
// Weighted by the inverse of its variance, S_ij = (c_ij + c_ji) / (N_i / A_i + N_j / A_j), where c
// are counts and N the rays of a patch. Rows must sum to A_i less what the patch's own rays lost.
// Scaling S_ij by g_i g_j makes them so and leaves S symmetric (row normalisation; Sinkhorn and
// Knopp 1967). After some scalings a little is still missing, or too much; this is what a patch
// exchanges with itself. So rows are closed and S is symmetric to the last bits. No energy is made
// or lost between patches, however reflective, and furnaces are exact.
//
// The matrix stores S before it is scaled, so that the S of several batches is their mean.

#include "parallel/ranks.h"
#include "radiosity/engine/factors/rows/escape_fraction.h"
#include "radiosity/engine/form_factors/ray_counts.h"
#include "radiosity/engine/sampling/sampling_kernels.h"
#include "radiosity/engine/sparse/sparse_rows.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class ExchangeMatrix {
  public:
    ExchangeMatrix() = default;
    /// Makes the matrix from the rays of one batch. `area` gives the area of each patch in local
    /// units. All ranks that have rays of the batch call this, as all functions that take workers.
    ExchangeMatrix(std::span<const double> area, const RayCounts& batch,
                   const Workers& workers = Workers(1));
    /// Makes the matrix from several batches, in each of which a patch shot the same number of
    /// rays.
    ExchangeMatrix(std::vector<ExchangeMatrix> batches, const Workers& workers);

    /// Computes y_i = sum_j F_ij x_j, by patch; y has the unit of x.
    void multiply(std::span<const Vec3> x, std::span<Vec3> y, const Workers& workers) const;

    /// Returns the element j of a vector as rows take it, to compute the same in parts.
    [[nodiscard]] Lanes scaled(std::size_t j, const Vec3& x) const {
        return {{scale_[j] * x.x, scale_[j] * x.y, scale_[j] * x.z, 0}};
    }
    /// Returns the product of the row i with a vector of such elements.
    [[nodiscard]] Vec3 row_times(std::size_t i, std::span<const Lanes> scaled) const {
        const std::span<const std::uint32_t> row = rows_.row(i);
        Lanes sum;
        kernels_->row_times(row.data(), row.size(), words().format(), scaled.data(), &sum);
        const auto channel = [&](int c) {
            return per_area_[i] * (sum.lane[c] + self_[i] * scaled[i].lane[c]);
        };
        return {channel(0), channel(1), channel(2)};
    }
    /// Returns F_ii [-], which closes the row i: what chance has left, of either sign.
    [[nodiscard]] double self_factor(std::size_t i) const {
        return per_area_[i] * self_[i] * scale_[i];
    }
    /// Calls body(begin, end) for chunks of this rank's rows, by as many threads as pay.
    template <class Body>
    void for_rows(const Workers& workers, const Body& body) const {
        readers(workers).for_chunks(own_.count(), rows_per_chunk,
                                    [&](std::size_t begin, std::size_t end) {
                                        body(own_.item(begin), own_.item(begin) + (end - begin));
                                    });
    }
    /// Does the same and counts the work of a product with each row.
    template <class Body>
    void for_products(const Workers& workers, const Body& body) const {
        count_products(1);
        for_rows(workers, body);
    }
    /// Counts the work of so many products with all of this rank's rows.
    void count_products(int products) const {
        own_.ranks().add_work(0, rows_.entries() * static_cast<std::size_t>(products));
    }
    static constexpr std::size_t rows_per_chunk = SparseRows::rows_per_chunk;
    static_assert(OwnBlocks::min_block % rows_per_chunk == 0, "a chunk is one rank's");
    /// Returns the rows that this rank has; a single rank has all.
    [[nodiscard]] const OwnBlocks& own_rows() const { return own_; }

    /// Returns what patch i exchanges with others; a value is S before it is scaled [local area].
    /// The row is empty where it is another rank's.
    [[nodiscard]] std::span<const std::uint32_t> row(std::size_t i) const { return rows_.row(i); }
    /// Returns how rows hold their entries.
    [[nodiscard]] const EntryWords& words() const { return rows_.words(); }
    /// Returns an entry for each patch.
    [[nodiscard]] std::span<const EscapeFraction> lost() const { return lost_; }
    /// Returns, by patch, the number of rays that it shot itself.
    [[nodiscard]] std::span<const double> rays() const { return rays_; }
    /// Returns the memory of the rows of all ranks, which all call this.
    [[nodiscard]] std::uint64_t bytes() const {
        return own_.ranks().sum(rows_.entries()) * sizeof(std::uint32_t);
    }

  private:
    void find_lost(const RayCounts& batch);
    void find_lost(std::span<const ExchangeMatrix> batches);
    void store(const RayCounts& batch);
    struct HitsOfOthers;
    [[nodiscard]] HitsOfOthers hits_of_others(const RayCounts& batch,
                                              std::span<const std::uint32_t> sizes) const;
    void close(int times, const Workers& workers);
    [[nodiscard]] std::vector<double> due(const Workers& workers) const;
    void find_scale(std::span<const double> due, int times, const Workers& workers);
    [[nodiscard]] Workers readers(const Workers& workers) const;

    const SamplingKernels* kernels_ = &sampling_kernels();
    OwnBlocks own_{one_rank(), 0};
    std::span<const double> area_; ///< local units
    /// The values S_ij; both rows hold the same number. A column may come twice in a row of a
    /// batch: as one patch saw the other, and was seen by it.
    SparseRows rows_;
    std::vector<double> scale_;    ///< g_i
    std::vector<double> per_area_; ///< g_i / A_i
    std::vector<double> self_;     ///< S_ii, which closes the row, not scaled
    std::vector<double> rays_;     ///< rays by patch
    std::vector<EscapeFraction> lost_;
};

} // namespace hemilux
