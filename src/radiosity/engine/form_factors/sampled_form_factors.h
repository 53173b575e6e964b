#pragma once
// Computes form factors of all patches by well-distributed rays, and puts together what each pair
// of patches saw of the other.
//
// From every patch N rays follow the cosine law; origin and direction together are a scrambled
// Sobol point. By reciprocity, A_i F_ij = A_j F_ji, the rays from i to j and from j to i estimate
// the same number. Weighted by the inverse of its variance, F_ij = A_j (c_ij + c_ji) / (N (A_i +
// A_j)), where c are the counts. Few rays find a small emitter. So the columns of emitters come
// from the closed form of point and polygon (Lambert) times the visibility along a ray drawn inside
// it. Rows are then closed: they sum to 1 minus the escape fraction, the share of the row's own
// rays that met no patch.

#include "bvh/tracer.h"
#include "parallel/workers.h"
#include "radiosity/engine/factors/rows/escape_fraction.h"
#include "radiosity/engine/form_factors/ray_counts.h"
#include "radiosity/engine/sparse/sparse_matrix.h"
#include "radiosity/paper/scene/needs.h"

#include <atomic>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace hemilux {

class Mesh;
struct Monitor;

class SampledFormFactors {
  public:
    /// Makes factors without rays. The columns of `emitters` are computed in closed form; there may
    /// be none. Patches that never hold power shoot no rays; their rows come from the rays of
    /// others and are not closed.
    SampledFormFactors(const Mesh& mesh, const Tracer& tracer, std::vector<std::uint32_t> emitters,
                       std::uint64_t seed, const Needs& needs = everything_needed);

    /// Traces until there are `rays` rays per patch (and about as many to the emitters). Returns
    /// the number of rays that this call traced; the factors are void if the monitor was
    /// interrupted meanwhile.
    std::uint64_t trace_up_to(std::uint32_t rays, const Workers& workers, Monitor& monitor);

    /// Returns F, merged and closed.
    [[nodiscard]] SparseMatrix matrix() const;
    /// Returns the number of rays per patch so far.
    [[nodiscard]] std::uint32_t rays() const { return rays_; }
    /// Returns the escape fractions by patch.
    [[nodiscard]] std::span<const EscapeFraction> lost() const { return lost_; }
    [[nodiscard]] std::span<const std::uint32_t> emitters() const { return emitters_; }
    /// Returns the share of an emitter's light that arrives [-], by the closed form; `emitter` is
    /// an index in emitters(). It is only right if all_receive().
    [[nodiscard]] double arriving_from(std::size_t emitter) const;
    /// Returns whether no patch is black; one that reflects and emits nothing may look at no
    /// emitter.
    [[nodiscard]] bool all_receive() const;

  private:
    std::uint64_t trace_emitters(std::uint32_t patch, std::uint32_t begin, std::uint32_t end);
    struct PatchHits {
        std::uint32_t patch, hits;
    };
    [[nodiscard]] std::vector<std::vector<PatchHits>> merged_counts() const;
    [[nodiscard]] std::uint32_t emitter_samples(std::uint32_t rays) const;
    [[nodiscard]] double factor_per_hit(std::uint32_t i, std::uint32_t j) const;

    const Mesh& mesh_;
    const Tracer& tracer_;
    std::vector<std::uint32_t> emitters_;
    std::vector<bool> is_emitter_;
    std::uint64_t seed_;
    const Needs& needs_;
    std::uint32_t rays_ = 0; ///< rays per patch so far
    RayCounts counts_;
    std::vector<EscapeFraction> lost_;
    std::vector<double> emitter_sum_; ///< sum of the samples per patch and emitter
};

} // namespace hemilux
