#pragma once
// Finds facets that lie in one plane and cover each other, wholly or in part. A wall may have a
// face for each of its sides, or a face may be there twice. An emitter may be drawn in the very
// plane of the ceiling.

#include "radiosity/paper/scene/scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

struct Overlap {
    std::uint32_t a, b; ///< facets, a < b
    auto operator<=>(const Overlap&) const = default;
};

/// The limits of the work that one scene may cause.
struct OverlapLimits {
    std::size_t comparisons, pairs;

    /// Returns limits that are far above what ordinary scenes need. A scene of few facets that all
    /// lie over each other takes about a second of work and 20 MB of pairs.
    [[nodiscard]] static OverlapLimits of(const Scene& scene) {
        return {2'000'000 + 64 * scene.facets.size(), 500'000 + 8 * scene.facets.size()};
    }
    /// The memory [bytes] that a pair takes until the facets are offset.
    static constexpr double bytes_per_pair = 40;
};

/// A facet that is left out, as others of its very shape that face its way lie over it.
struct Buried {
    std::uint32_t facet, under; ///< `under`: the lowest of those that were kept
};

struct Overlaps {
    std::vector<Overlap> pairs; ///< sorted; of facets that are not buried
    std::vector<Buried> buried; ///< buried facets by shape
    bool complete = true;       ///< false where there was more to be compared than allowed
};

/// Finds the pairs whose corners lie within 2^-37 of a common plane and which share more than about
/// a ten-thousandth of the smaller one's area. Neighbours that touch do not count, and what is
/// narrower than 2^-21 is ignored. `vertices` are those of the scene in its local frame, within
/// [-1,1]^3.
///
/// Takes O(n log n) time for facets that are disjoint (plane_cuts.h), besides some comparisons of
/// boxes for each, sqrt(n) for n tiles. For others it takes as many comparisons as there are pairs.
/// Beyond the limits the rest is ignored.
///
/// Of facets with the same corners that face one way, the brightest are kept, or the first. They
/// are so many that each of `kept_alike` has a level of its own; the others are buried under them.
/// So n facets in one place do not take n^2 pairs.
[[nodiscard]] Overlaps find_overlaps(const Scene& scene, std::span<const Vec3> vertices,
                                     const OverlapLimits& limits);
[[nodiscard]] inline Overlaps find_overlaps(const Scene& scene, std::span<const Vec3> vertices) {
    return find_overlaps(scene, vertices, OverlapLimits::of(scene));
}

inline constexpr std::size_t kept_alike = 16;

} // namespace hemilux
