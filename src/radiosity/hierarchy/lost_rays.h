#pragma once
// The light that leaves the scene or falls on backs of faces, which links do not report, and with
// it how the rows of a system of links are closed.
//
// A row of form factors sums to 1 less the share of the patch's light that is lost. That sum is
// known twice, by the factors of the links and by rays that look where light goes; each is weighted
// by the inverse of its variance. What the factors lack to the sum, or have too much, is what the
// patch exchanges with itself.

#include "radiosity/form_factors/ray_counts.h"
#include "radiosity/form_factors/sampled_form_factors.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

/// Cosine-distributed rays of all patches in independent batches.
class LostRays {
  public:
    /// The mesh and the tracer outlive this.
    LostRays(const Mesh& mesh, const Tracer& tracer, std::uint64_t seed, std::size_t batches);

    /// Goes on until all batches together have `rays` per patch, and eight times as many where
    /// light is emitted [W/m2, by patch]. Returns how many were traced now; the monitor reports an
    /// interrupt.
    std::uint64_t trace_up_to(double rays, std::span<const Vec3> emission, const Workers& workers,
                              Monitor& monitor);

    [[nodiscard]] std::size_t batches() const { return batches_.size(); }
    [[nodiscard]] std::size_t patches() const { return rays_.size(); }
    /// How many each patch has in each batch.
    [[nodiscard]] std::span<const double> rays_of_batch() const { return rays_; }
    /// Shares of a patch's rays; 0 where it has none.
    [[nodiscard]] EscapeFraction lost(std::size_t batch, std::size_t patch) const;
    /// Of all rays that were lost, the share that left the scene; 1 where none was lost.
    [[nodiscard]] double prior_escape() const;

    /// The share of all reflected light that is in doubt, as rays that were lost are counted: the
    /// standard deviation of their number, which is Poisson distributed where a patch loses few and
    /// scatters less where it loses many well-distributed ones, and three that might have been lost
    /// besides. Areas are local, light in W/m2, by patch.
    [[nodiscard]] double uncertain_light(std::span<const double> area,
                                         std::span<const Vec3> radiosity,
                                         std::span<const Vec3> emission) const;

  private:
    std::vector<RayCounts> batches_;
    std::vector<double> rays_; ///< by patch, in each batch
};

/// How the rows of one batch end, by patch.
struct NormalisedRows {
    std::vector<double> self; ///< the factor of a patch to itself, of either sign
    std::vector<EscapeFraction> lost;
};

/// By batch. `sums`: of the rows of factors, by batch and patch. Without any rays no light is lost.
[[nodiscard]] std::vector<NormalisedRows> normalise_rows(const LostRays& lost,
                                                         std::span<const std::vector<double>> sums);

} // namespace hemilux
