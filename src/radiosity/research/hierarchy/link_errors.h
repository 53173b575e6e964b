#pragma once
// The errors of a solution over links besides the noise of its factors: nodes have one light, and
// no ray has arrived along some links.

#include "geometry/vector.h"
#include "radiosity/research/hierarchy/links.h"
#include "radiosity/research/hierarchy/patch_tree.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

/// Returns the squares by patch [(W/m2)^2] of the errors that nodes may have after a refinement,
/// from the light by patch [W/m2] before it and after it. Each refinement about halves the errors
/// of nodes.
[[nodiscard]] std::vector<Vec3> squares_of_changes(const PatchTree& tree,
                                                   std::span<const double> area,
                                                   std::span<const Vec3> before,
                                                   std::span<const Vec3> after);

/// Returns the squares by patch [(W/m2)^2 arriving] of what links may bring of which no ray arrived
/// in any batch: up to three of them might have. `points[l]` are those of link l in a batch, and
/// `radiosity` [W/m2] is by patch.
[[nodiscard]] std::vector<Vec3> missed_over_links(const PatchTree& tree, const Links& links,
                                                  std::span<const LinkFactors> batches,
                                                  std::span<const std::uint32_t> points,
                                                  std::span<const Vec3> radiosity);

} // namespace hemilux
