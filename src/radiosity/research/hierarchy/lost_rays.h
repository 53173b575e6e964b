#pragma once
// The light that leaves the scene or falls on backs of faces, which links do not report. It
// determines how the rows of a system of links are closed.
//
// A row of form factors sums to 1 less the share of the patch's light that is lost. That sum is
// known twice, by the factors of the links and by rays that look where light goes; each is weighted
// by the inverse of its variance. What the factors lack to the sum, or have too much, is what the
// patch exchanges with itself.

#include "radiosity/engine/factors/rows/escape_fraction.h"
#include "radiosity/engine/form_factors/ray_counts.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

/// The cosine-distributed rays of all patches in independent batches.
class LostRays {
  public:
    LostRays(const Mesh& mesh, const Tracer& tracer, std::uint64_t seed, std::size_t batches);

    /// Goes on until all batches together have `rays` per patch, and eight times as many where
    /// light is emitted [W/m2, by patch]. Returns how many it traced; the monitor reports an
    /// interrupt.
    std::uint64_t trace_up_to(double rays, std::span<const Vec3> emission, const Workers& workers,
                              Monitor& monitor);

    [[nodiscard]] std::size_t batches() const { return batches_.size(); }
    [[nodiscard]] std::size_t patches() const { return rays_.size(); }
    /// Returns how many rays each patch has in each batch.
    [[nodiscard]] std::span<const double> rays_of_batch() const { return rays_; }
    /// Returns the lost shares of a patch's rays; 0 if it has none.
    [[nodiscard]] EscapeFraction lost(std::size_t batch, std::size_t patch) const;
    /// Returns the share of all lost rays that left the scene; 1 if none was lost.
    [[nodiscard]] double prior_escape() const;

    /// Returns the share of all reflected light that is in doubt, as rays that were lost are
    /// counted. One part is the standard deviation of their number. It is Poisson distributed where
    /// a patch loses few, and scatters less where it loses many well-distributed ones. The other
    /// part is three rays that might have been lost besides. Areas are local, light in W/m2, by
    /// patch.
    [[nodiscard]] double uncertain_light(std::span<const double> area,
                                         std::span<const Vec3> radiosity,
                                         std::span<const Vec3> emission) const;

  private:
    std::vector<RayCounts> batches_;
    std::vector<double> rays_; ///< rays by patch, in each batch
};

/// This is how the rows of one batch end, by patch.
struct NormalisedRows {
    std::vector<double> self; ///< the factor of a patch to itself, of either sign
    std::vector<EscapeFraction> lost;
};

/// Returns the row normalisation by batch. `sums` are those of the rows of factors, by batch and
/// patch. Without any rays no light is lost.
[[nodiscard]] std::vector<NormalisedRows> normalise_rows(const LostRays& lost,
                                                         std::span<const std::vector<double>> sums);

} // namespace hemilux
