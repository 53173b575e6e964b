#pragma once
// Orders facets that lie in one plane and cover each other, wholly or in part, into layers.
//
// Without layers, rounding errors would decide which of them a ray hits. What one patch sees of
// another would not be what the other sees of it. So each side of a sheet lies to its front. Of
// those that face the same way the brightest is on top, else the smaller by far, else the first.

#include "geometry/vector.h"
#include "radiosity/paper/scene/scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

struct CoplanarLayers {
    /// The number of steps by which each facet is moved to its front (Mesh decides how long they
    /// are). It is empty if no facet is to be moved.
    std::vector<std::int32_t> offset;
    /// Facets that nothing can reach, as many others of their shape that face their way lie over
    /// them. They lie beside the lowest of these.
    std::vector<std::uint32_t> buried;
    std::size_t covered = 0; ///< facets wholly or partly under another that faces the same way
    bool complete = true;    ///< coplanar_overlaps.h
};

/// Finds the layers; `vertices` are those of the scene in its local frame. Among facets that
/// overlaps connect, the level with the largest area stays where it is, so that closed rooms remain
/// closed. A chain of alike facets, each over its neighbour, takes two levels.
[[nodiscard]] CoplanarLayers find_coplanar_layers(const Scene& scene,
                                                  std::span<const Vec3> vertices);

/// Unites facets that a file holds thousands of times, each time moved or turned by rounding;
/// without this, rays would have to test all of them. Call it before find_coplanar_layers(). Where
/// more than `kept_alike` facets face one way and their corners differ by less than about 2^-18 of
/// their width, all get the corners of the first. They are then in one place. Takes O(n) time, and
/// O(n log n) where there are such facets.
void unite_near_twins(Scene& scene, std::span<const Vec3> vertices);

} // namespace hemilux
