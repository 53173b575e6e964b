#pragma once
// Links of hierarchical radiosity (Hanrahan, Salzman and Aupperle 1991). A node gathers light from
// another as if this were one patch. Each pair of patches that may see each other is linked once,
// at some level.

#include "bvh/tracer.h"
#include "parallel/workers.h"
#include "radiosity/research/hierarchy/patch_tree.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

struct Monitor;

/// Joins two nodes: `to` gathers from `from`.
struct Link {
    std::uint32_t to, from;
};

/// Estimates F_to,from [-] as if nothing stood between, rather too high than too low.
[[nodiscard]] double rough_factor(const PatchTree::Node& to, const PatchTree::Node& from);

enum class Refinement { not_needed, done, too_many_links };

class Links {
  public:
    /// Links all roots that may see each other. Throws SolveError if there are too many.
    Links(const Mesh& mesh, const PatchTree& tree);

    /// Divides the links by which more than `max_power` may be reflected, the larger node of each:
    /// the oracle BF with areas. `light` [W/m2 leaving] and `reflectance` [-] are by patch, means
    /// of channels; `max_power` is in W/m2 times local area. No link is divided if there would be
    /// too many.
    Refinement refine(std::span<const double> light, std::span<const double> reflectance,
                      double max_power);

    [[nodiscard]] std::span<const Link> all() const { return links_; }
    /// Returns whether all are between patches, so that nodes stand for nothing.
    [[nodiscard]] bool are_whole() const;

  private:
    [[nodiscard]] bool may_see(const Link& link) const;

    const Mesh& mesh_;
    const PatchTree& tree_;
    std::vector<Link> links_;
};

/// The factors of all links in one batch.
class LinkFactors {
  public:
    /// Estimates F_to,from [-] by `points[l]` random pairs of a point of the one and a patch of the
    /// other. Each gives the closed form of point and polygon times the visibility along a ray.
    /// This is unbiased for the mean over the node. It is void if the monitor was interrupted.
    LinkFactors(const Mesh& mesh, const Tracer& tracer, const PatchTree& tree, const Links& links,
                std::span<const std::uint32_t> points, std::uint64_t seed, const Workers& workers,
                Monitor& monitor);

    /// Has an entry for each link.
    [[nodiscard]] std::span<const double> factors() const { return factors_; }
    /// Computes y_i = sum_j F_ij x_j, by patch: pull, gather, push.
    void multiply(std::span<const double> x, std::span<double> y) const;
    [[nodiscard]] std::uint64_t rays() const { return rays_; }

  private:
    const PatchTree& tree_;
    const Links& links_;
    std::vector<double> factors_;
    std::uint64_t rays_ = 0;
};

} // namespace hemilux
