#pragma once
// Computes form factors without chance, for small scenes. Where nothing can stand between two
// patches it integrates along their contours (exchange_area.h); it samples only where something
// may.

#include "geometry/box.h"
#include "geometry/polygon.h"
#include "radiosity/engine/form_factors/sampled_form_factors.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hemilux {

/// The largest number of patches; more would take very long.
inline constexpr std::size_t max_patches_for_exact_factors = 2000;

class ExactFormFactors {
  public:
    /// Finds the factors of all pairs of patches that see each other fully. Work grows as patches^2
    /// facets: it suits a few thousand patches. The result is void if the monitor was interrupted.
    ExactFormFactors(const Mesh& mesh, const Workers& workers, const Monitor& monitor);

    /// Returns the matrix, with the sampled factors for the other pairs. Rows are closed: they sum
    /// to 1 minus what is lost.
    [[nodiscard]] SparseMatrix matrix(const SampledFormFactors& sampled) const;

    /// Returns F_ij [-] where it is known without sampling; 0 where the two do not face each other.
    [[nodiscard]] std::optional<double> factor(std::uint32_t i, std::uint32_t j) const;
    /// Counts the pairs that face each other and whose factors need no sampling.
    [[nodiscard]] std::uint64_t exact_pairs() const;
    [[nodiscard]] std::uint64_t sampled_pairs() const;

  private:
    struct Entry {
        std::uint32_t patch;
        double factor; ///< F [-]; < 0: to be sampled
    };
    /// Finds the pairs of a patch with patches of higher index. `shapes`, in boxes, may stand
    /// between patches: first all facets.
    void find_row(const Mesh& mesh, std::uint32_t patch, std::span<const Polygon> shapes,
                  std::span<const Box> boxes);

    std::vector<std::vector<Entry>> rows_; ///< entries by patch, ascending
};

} // namespace hemilux
