#pragma once
// The share of two patches that sees the other, by rays between points of them: for factors so
// small that a few rays are as exact as need be.

#include "bvh/tracer.h"
#include "radiosity/engine/factors/pairs/free_exchange.h"

#include <cstdint>
#include <vector>

namespace hemilux {

/// Collects the rays of many pairs, which are traced together.
class PairRays {
  public:
    explicit PairRays(const Tracer& tracer) : tracer_(tracer) {}

    /// Adds `count` rays from the face of facet `from` to that of facet `to`. Their points are
    /// those of one scrambled sequence (Cranley and Patterson 1976).
    void add(const FacePlane& a, std::uint32_t from, const FacePlane& b, std::uint32_t to,
             std::uint32_t count, std::uint64_t seed);
    [[nodiscard]] std::size_t size() const { return rays_.size(); }

    struct Share {
        double seen = 0, all = 0; ///< sums of the kernel over rays, in one unit; panes dim `seen`
        double squares = 0;       ///< sum of the squares of the kernel over rays
        std::uint32_t rays = 0, arrived = 0;
    };
    /// Traces all rays; calls use(pair, share) for each pair in the order in which they were added.
    /// Forgets them.
    template <class Use>
    void trace(const Use& use) {
        blocked_.resize(rays_.size());
        tracer_.occluded_stream(rays_, targets_, blocked_);
        std::size_t begin = 0;
        for (std::size_t pair = 0; pair < ends_.size(); ++pair) {
            use(pair, share(begin, ends_[pair]));
            begin = ends_[pair];
        }
        rays_.clear();
        targets_.clear();
        kernel_.clear();
        ends_.clear();
    }

  private:
    [[nodiscard]] Share share(std::size_t begin, std::size_t end) const;

    const Tracer& tracer_;
    std::vector<Ray> rays_;
    std::vector<std::uint32_t> targets_;
    std::vector<double> kernel_;
    std::vector<std::size_t> ends_; ///< by pair
    std::vector<std::uint8_t> blocked_;
};

} // namespace hemilux
