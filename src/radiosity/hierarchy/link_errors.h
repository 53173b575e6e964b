#pragma once
// What a solution over links may be off by besides the noise of its factors: nodes have one light,
// and no ray has arrived along some links.

#include "geometry/vector.h"
#include "radiosity/hierarchy/links.h"
#include "radiosity/hierarchy/patch_tree.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

/// By how much the last refinement has changed the light: each about halves what nodes err by.
class RefinementChanges {
  public:
    explicit RefinementChanges(std::size_t patches) : squares_(patches) {}

    /// From the light by patch [W/m2] before a refinement and after it.
    void measure(const PatchTree& tree, std::span<const double> area, std::span<const Vec3> before,
                 std::span<const Vec3> after);
    /// Links between patches alone err by nothing.
    void clear() { squares_.assign(squares_.size(), Vec3(0.0)); }

    /// Whether there was any refinement; without one it is not known by how much nodes err.
    [[nodiscard]] bool are_measured() const { return are_measured_; }
    /// By patch [(W/m2)^2].
    [[nodiscard]] std::span<const Vec3> squares() const { return squares_; }

  private:
    std::vector<Vec3> squares_;
    bool are_measured_ = false;
};

/// Squares by patch [(W/m2)^2 arriving] of what links may bring of which no ray arrived in any
/// batch: up to three of them might have. `points[l]` are those of link l in a batch, `radiosity`
/// [W/m2] is by patch.
[[nodiscard]] std::vector<Vec3> missed_over_links(const PatchTree& tree, const Links& links,
                                                  std::span<const LinkFactors> batches,
                                                  std::span<const std::uint32_t> points,
                                                  std::span<const Vec3> radiosity);

} // namespace hemilux
