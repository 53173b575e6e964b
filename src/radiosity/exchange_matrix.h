#pragma once
// What all patches exchange with each other, from the rays of all.
//
// S_ij = A_i F_ij is symmetric, so rays from i to j and from j to i tell the same number; weighted
// by what each is worth, S_ij = (c_ij + c_ji) / (N_i / A_i + N_j / A_j), c being counts and N the
// rays of a patch. Rows must sum to A_i less what the patch's own rays lost. Scaling S_ij by g_i
// g_j makes them so and leaves S symmetric (Sinkhorn and Knopp 1967): then no energy is made or
// lost between patches, however reflective, and furnaces are exact.

#include "radiosity/ray_counts.h"
#include "radiosity/sampled_form_factors.h"

#include <cstdint>
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
    [[nodiscard]] std::size_t entries() const { return column_.size(); }
    [[nodiscard]] std::uint64_t bytes() const {
        return entries() * (sizeof(float) + sizeof(std::uint32_t));
    }

  private:
    void merge(std::span<const RayCounts> sets);
    void close(const Workers& workers);

    std::vector<std::size_t> row_begin_; ///< one more than rows
    std::vector<std::uint32_t> column_;
    std::vector<float> value_;  ///< S_ij before scaling
    std::vector<double> scale_; ///< g
    std::vector<double> area_;
    std::vector<double> rays_, rays_per_area_;
    std::vector<LostShare> lost_;
};

} // namespace hemilux
