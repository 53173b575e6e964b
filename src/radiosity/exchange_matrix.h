#pragma once
// What all patches exchange with each other, from the rays of all.
//
// S_ij = A_i F_ij is symmetric, so rays from i to j and from j to i tell the same number; weighted
// by what each is worth, S_ij = (c_ij + c_ji) / (N_i / A_i + N_j / A_j), c being counts and N the
// rays of a patch. Rows must sum to A_i less what the patch's own rays lost. Scaling S_ij by g_i
// g_j makes them so and leaves S symmetric (Sinkhorn and Knopp 1967). The little that is still
// missing after some scalings, or too much, is what a patch exchanges with itself: so rows are
// closed and S is symmetric to the last bits, no energy is made or lost between patches, however
// reflective, and furnaces are exact.

#include "radiosity/ray_counts.h"
#include "radiosity/sampled_form_factors.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace hemilux {

class ExchangeMatrix {
  public:
    /// The rays of all these sets together.
    ExchangeMatrix(const Mesh& mesh, std::span<const RayCounts> sets, const Workers& workers);

    /// y_i = sum_j F_ij x_j
    void multiply(std::span<const Vec3> x, std::span<Vec3> y, const Workers& workers) const;
    /// By patch.
    [[nodiscard]] std::span<const LostShare> lost() const { return lost_; }
    /// Those that the patch shot itself.
    [[nodiscard]] std::span<const double> rays() const { return rays_; }
    [[nodiscard]] std::uint64_t bytes() const { return row_begin_.back() * sizeof(Entry); }

  private:
    struct Entry {
        std::uint32_t column;
        float value; ///< S_ij; the same number in both rows
    };
    struct Row {
        const Entry *begin_, *end_;
        [[nodiscard]] const Entry* begin() const { return begin_; }
        [[nodiscard]] const Entry* end() const { return end_; }
    };
    [[nodiscard]] Row row(std::size_t i) const {
        return {&entry_[row_begin_[i]], &entry_[row_begin_[i]] + row_size_[i]};
    }
    void find_lost(std::span<const RayCounts> sets);
    void merge(std::span<const RayCounts> sets, const Workers& workers);
    [[nodiscard]] std::vector<double> find_scale(const Workers& workers) const;
    void close(const std::vector<double>& scale, const Workers& workers);
    /// What the row i is to sum to; less than 0: unknown, as the patch itself has not looked.
    [[nodiscard]] double due(std::size_t i) const;
    [[nodiscard]] Workers readers(const Workers& workers) const;

    std::vector<std::size_t> row_begin_; ///< one more than rows; rows have room for more
    std::vector<std::uint32_t> row_size_;
    std::unique_ptr<Entry[]> entry_;
    std::vector<double> self_; ///< S_ii, which closes the row
    std::vector<double> area_;
    std::vector<double> rays_, rays_per_area_;
    std::vector<LostShare> lost_;
};

} // namespace hemilux
