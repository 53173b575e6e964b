#pragma once
// Form factors by integrals: exact where nothing stands between two patches, by lines between them
// where something does (factors/rows/find_exchange.h), and closed so that rows sum to 1 with what
// is lost and both factors of a pair belong to one exchange (factors/rows/closing.h).
//
// The pairs with nothing between are found once. All others, and what is lost, are estimated in
// independent batches. How results by several batches spread is their error, which so holds what
// closing makes of the errors of single factors.

#include "bvh/wide/wide_bvh.h"
#include "parallel/workers.h"
#include "radiosity/engine/factors/pairs/free_pairs.h"
#include "radiosity/engine/factors/rows/escape_fraction.h"
#include "radiosity/engine/factors/rows/find_exchange.h"
#include "radiosity/engine/sparse/sparse_matrix.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;
struct Monitor;

/// A batch: all rows sum to 1 with what is lost, and A_i F_ij = A_j F_ji.
struct ClosedFactors {
    SparseMatrix matrix;              ///< entries of a row are ascending by column
    std::vector<EscapeFraction> lost; ///< by patch
    std::uint64_t rays = 0;           ///< traced for it
    /// What rows are off by at most where the iterations that close them ended at their limit [-].
    double unclosed = 0;
};

class ClosedFormFactors {
  public:
    /// The fewest rays of a patch.
    static constexpr std::uint32_t min_rays = 256;

    /// Finds the pairs with nothing between, which takes time as the square of the patches. Mesh
    /// and tracer must outlive this, which is void if the monitor was interrupted.
    ClosedFormFactors(const Mesh& mesh, const Tracer& tracer, const Workers& workers,
                      Monitor& monitor);

    /// Counts the pairs that face each other, with nothing between them and with something.
    [[nodiscard]] std::uint64_t clear_pairs() const { return pairs_.clear_count; }
    [[nodiscard]] std::uint64_t other_pairs() const { return pairs_.count - pairs_.clear_count; }
    /// Returns F_ij [-] where nothing stands between the two, 0 where they do not face each other;
    /// nothing where something may hide a part.
    [[nodiscard]] std::optional<double> factor(std::uint32_t i, std::uint32_t j) const;

    /// Returns what of the light that leaves patches would arrive at each if nothing hid it.
    [[nodiscard]] std::vector<double> free_light(std::span<const double> leaving) const;

    /// Estimates the others with `rays` rays from each patch, a power of two and min_rays at least,
    /// and closes the rows. Returns nothing if the monitor was interrupted. The same seed gives the
    /// same bytes for any number of threads.
    [[nodiscard]] std::optional<ClosedFactors> batch(std::uint64_t seed, std::uint32_t rays,
                                                     const FactorTolerance& tolerance,
                                                     const Workers& workers,
                                                     Monitor& monitor) const;

  private:
    const Mesh& mesh_;
    const Tracer& tracer_;
    WideBvh tree_;
    FreePairs pairs_;
};

} // namespace hemilux
