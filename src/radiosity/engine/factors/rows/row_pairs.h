#pragma once
// The pairs of one patch with those of higher index: which of them see each other, and how much
// they exchange.

#include "radiosity/engine/factors/pairs/facing_patches.h"
#include "radiosity/engine/factors/pairs/hidden_exchange.h"
#include "radiosity/engine/factors/pairs/pair_rays.h"
#include "radiosity/engine/factors/rows/find_exchange.h"
#include "radiosity/engine/factors/rows/seen_pairs.h"
#include "radiosity/paper/sampling/rng.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

/// What all rows are found of.
struct PairSearch {
    const Mesh& mesh;
    const WideBvh& tree;
    const Tracer& tracer;           ///< also of panes
    std::span<const Polygon> panes; ///< that the tracer dims light by
    const ExchangeOptions& options;
    std::span<const FacePlane> faces; ///< by patch
    const FacingPatches& groups;
    std::span<const std::vector<SeenPair>> seen; ///< by patch
};

/// It has memory of its own; one for each thread.
class RowPairs {
  public:
    /// Tolerances are `scale` times those of the options.
    RowPairs(const PairSearch& search, double scale)
        : mesh_(search.mesh), options_(search.options), faces_(search.faces),
          groups_(search.groups), seen_(search.seen), scale_(scale), rays_(search.tracer),
          probes_(search.tracer), hidden_(search.mesh, search.tree, search.panes),
          is_seen_(faces_.size()) {}

    /// Measures the pairs of a patch with those of higher index.
    void measure(std::uint32_t i, MeasuredRow& row);

  private:
    struct Candidate {
        std::uint32_t to;
        Facing facing;
        std::uint32_t probes; ///< rays that look for it where no ray of a row found it
        double free;          ///< the free exchange, exactly; 0: not known yet
        std::uint32_t hits;   ///< rays of either patch that hit the other, if `free` is known
    };
    /// A pair that is estimated by rays alone.
    struct Small {
        std::size_t place; ///< in the row's pairs
        std::uint32_t rays;
        Candidate pair;
        double free;
    };
    void look_for(std::uint32_t i);
    void list_hidden(std::uint32_t i);
    [[nodiscard]] PairExchange pooled(std::uint32_t i, const Candidate& pair, double share,
                                      double variance, double rays) const;
    void probe(std::uint32_t i, MeasuredRow& row);
    [[nodiscard]] std::uint32_t probes_of(double bound, double tolerance) const;
    /// Returns the chance that a pair was found by no ray.
    [[nodiscard]] double missed_chance(std::uint32_t i, const Candidate& pair, double exchange,
                                       double share) const;
    void estimate(std::uint32_t i, const Candidate& pair, MeasuredRow& row);
    void trace_small(std::uint32_t i, MeasuredRow& row);
    [[nodiscard]] std::uint64_t seed_of(std::uint32_t i, std::uint32_t j, std::uint64_t use) const {
        return hash_words({options_.seed, i, j, use});
    }
    [[nodiscard]] double tolerance(std::uint32_t i, std::uint32_t j, double exchange) const {
        const double smaller = std::min(faces_[i].area, faces_[j].area);
        return scale_ * smaller * options_.tolerance.of(i, j, exchange / smaller);
    }

    const Mesh& mesh_;
    const ExchangeOptions& options_;
    std::span<const FacePlane> faces_;
    const FacingPatches& groups_;
    std::span<const std::vector<SeenPair>> seen_;
    double scale_;
    PairRays rays_, probes_;
    HiddenExchange hidden_;
    std::vector<bool> is_seen_; ///< by patch, of the row
    std::vector<Candidate> candidates_, unseen_;
    std::vector<Small> small_;
};

} // namespace hemilux
