#pragma once
// Facets that lie in the same place, corner on corner: a wall modelled with a face for each of its
// sides, or a face that is there twice.
//
// Which of them a ray strikes would be left to rounding errors, and what one patch sees of another
// would not be what the other sees of it. So they are laid one upon the other: of those that face
// the same way the brightest is on top, else the first.

#include "geometry/vector.h"
#include "radiosity/scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

struct Stacks {
    /// By facet, how many steps it is to be moved to its front; empty where none is to be.
    std::vector<std::uint32_t> lift;
    std::size_t covered = 0; ///< facets under another that faces the same way
};

/// `vertices` are those of the scene in any units. O(n log n); facets that overlap without having
/// all corners in common are not found.
[[nodiscard]] Stacks find_stacks(const Scene& scene, std::span<const Vec3> vertices);

} // namespace hemilux
