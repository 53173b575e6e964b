#pragma once
// Facets that lie in one plane and cover each other, wholly or in part, laid one upon the other.
//
// Which of them a ray hits would be left to rounding errors, and what one patch sees of another
// would not be what the other sees of it. So each side of a sheet lies to its front, and of those
// that face the same way the brightest is on top, else the smaller by far, else the first.

#include "geometry/vector.h"
#include "radiosity/scene/scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

struct CoplanarLayers {
    /// By facet: how many steps it is to be moved to its front (Mesh decides how long they are).
    /// Empty if no facet is to be moved.
    std::vector<std::int32_t> offset;
    /// Facets that nothing can reach, as many others of their shape that face their way lie over
    /// them. They lie beside the lowest of these.
    std::vector<std::uint32_t> buried;
    std::size_t covered = 0; ///< facets wholly or partly under another that faces the same way
    bool complete = true;    ///< coplanar_overlaps.h
};

/// `vertices` are those of the scene in its local frame. Among facets that overlaps connect, the
/// level with the largest area stays where it is, so that closed rooms remain closed. A chain of
/// alike facets, each over its neighbour, takes two levels.
[[nodiscard]] CoplanarLayers find_coplanar_layers(const Scene& scene,
                                                  std::span<const Vec3> vertices);

/// To be done before, for what was put into a file thousands of times, each time moved or turned by
/// rounding: rays would have to test all of it. Where more than `kept_alike` facets face one way
/// and their corners differ by less than about 2^-18 of their width, all get the corners of the
/// first, so that they are in one place. O(n), and O(n log n) where there are such.
void unite_near_twins(Scene& scene, std::span<const Vec3> vertices);

} // namespace hemilux
