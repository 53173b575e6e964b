#pragma once
// Form factors without chance, for small scenes: by contour integration (exchange_area.h) where
// nothing can stand between two patches, by sampling only where something may.

#include "geometry/box.h"
#include "radiosity/form_factors/sampled_form_factors.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hemilux {

/// More would take very long.
inline constexpr std::size_t most_patches_for_exact_factors = 2000;

class ExactFormFactors {
  public:
    /// All pairs of patches that see each other fully. Work grows as patches^2 facets: for a few
    /// thousand patches. Void if the monitor was interrupted. The mesh outlives this.
    ExactFormFactors(const Mesh& mesh, const Workers& workers, const Monitor& monitor);

    /// With the sampled factors for the other pairs, these scaled so that rows are closed. They
    /// must have been made without emitters.
    [[nodiscard]] SparseMatrix matrix(const SampledFormFactors& sampled) const;

    /// F_ij [-] where it is known without sampling; 0 where the two do not face each other.
    [[nodiscard]] std::optional<double> factor(std::uint32_t i, std::uint32_t j) const;
    /// Pairs that face each other.
    [[nodiscard]] std::uint64_t exact_pairs() const;
    [[nodiscard]] std::uint64_t sampled_pairs() const;

  private:
    struct Entry {
        std::uint32_t patch;
        double factor; ///< F [-]; < 0: to be sampled
    };
    /// Pairs with patches of higher index.
    void find_row(std::uint32_t patch, std::span<const Box> facet_boxes);

    const Mesh& mesh_;
    std::vector<std::vector<Entry>> rows_; ///< by patch, ascending
};

} // namespace hemilux
