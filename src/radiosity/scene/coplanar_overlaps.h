#pragma once
// Facets that lie in one plane and cover each other, wholly or in part: a wall with a face for each
// of its sides, a face that is there twice, a lamp drawn in the very plane of the ceiling.

#include "radiosity/scene/scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

struct Overlap {
    std::uint32_t a, b; ///< facets, a < b
    auto operator<=>(const Overlap&) const = default;
};

/// How much work one scene may cause.
struct OverlapLimits {
    std::size_t comparisons, pairs;

    /// These limits are far more than ordinary scenes need. A scene of few facets that all lie over
    /// each other takes about a second of work and 20 MB of pairs.
    [[nodiscard]] static OverlapLimits of(const Scene& scene) {
        return {2'000'000 + 64 * scene.facets.size(), 500'000 + 8 * scene.facets.size()};
    }
    /// Memory that a pair takes until the facets are offset.
    static constexpr double bytes_per_pair = 40;
};

/// A facet that was left out, as others of its very shape that face its way lie over it.
struct Buried {
    std::uint32_t facet, under; ///< `under`: the lowest of those that were kept
};

struct Overlaps {
    std::vector<Overlap> pairs; ///< sorted; of facets that are not buried
    std::vector<Buried> buried; ///< by shape
    bool complete = true;       ///< false where there was more to be compared than allowed
};

/// `vertices` are those of the scene in its local frame, within [-1,1]^3. Finds the pairs whose
/// corners lie within 2^-37 of a common plane and which have more in common than about a
/// ten-thousandth of the smaller one's area; neighbours that touch are none. What is narrower than
/// 2^-21 is let be. O(n log n) for facets that are disjoint (plane_cuts.h), besides some
/// comparisons of boxes for each, sqrt(n) for n tiles; for others as many comparisons as there are
/// pairs. Beyond the limits the rest is let be.
///
/// Of facets with the same corners that face one way the brightest are kept, or the first, so many
/// that each of `kept_alike` has a level of its own; the others are buried under them. So n facets
/// in one place take no n^2 pairs.
[[nodiscard]] Overlaps find_overlaps(const Scene& scene, std::span<const Vec3> vertices,
                                     const OverlapLimits& limits);
[[nodiscard]] inline Overlaps find_overlaps(const Scene& scene, std::span<const Vec3> vertices) {
    return find_overlaps(scene, vertices, OverlapLimits::of(scene));
}

inline constexpr std::size_t kept_alike = 16;

} // namespace hemilux
