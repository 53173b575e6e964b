#pragma once
// Facets that lie in one plane and cover each other, wholly or in part: a wall with a face for each
// of its sides, a face that is there twice, a lamp drawn in the very plane of the ceiling.

#include "radiosity/scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

struct Overlap {
    std::uint32_t a, b; ///< facets, a < b
    auto operator<=>(const Overlap&) const = default;
};

struct Overlaps {
    std::vector<Overlap> pairs; ///< sorted
    bool complete = true;       ///< false where there was more to be compared than allowed
};

/// `vertices` are those of the scene in its local frame, within [-1,1]^3. Finds the pairs whose
/// corners lie within 2^-37 of a common plane and which have more in common than about a
/// ten-thousandth of the smaller one's area; neighbours that touch are none. What is narrower than
/// 2^-21 is let be. O(n log n + pairs), except for thousands of slivers whose boxes lie over each
/// other: those of one face are taken for disjoint, and after `most` comparisons the rest is let
/// be.
[[nodiscard]] Overlaps find_overlaps(const Scene& scene, std::span<const Vec3> vertices,
                                     std::size_t most = 50'000'000);

} // namespace hemilux
