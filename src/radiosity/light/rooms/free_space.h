#pragma once
// Finds where somebody can stand and look around in a scene: rooms, the air around things, the land
// under the sky.
//
// A grid of some thousand places covers the box of the scene. From each, two dozen rays look
// around. A place from which nearly all that is near shows its back lies within a wall or a thing,
// or behind the walls of a room, and is left out. Two neighbours belong to one space where nothing
// stands between them. So walls of any thickness keep rooms apart, doors join them, and cracks do
// not.

#include "bvh/tracer.h"
#include "geometry/vector.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hemilux {

class Mesh;

/// A place on a surface that can be looked at, on the side that can be seen.
struct SeenPlace {
    Vec3 point;  ///< local frame
    Vec3 normal; ///< unit, towards where it is seen from
    std::uint32_t facet;
};

/// Returns the place that a ray sees; empty where it leaves the scene, or sees a back.
[[nodiscard]] std::optional<SeenPlace> place_seen(const Mesh& mesh, const Tracer& tracer,
                                                  const Ray& ray);

/// Places that hang together.
struct Space {
    std::vector<Vec3> places;    ///< local frame
    std::vector<SeenPlace> seen; ///< some of what can be looked at from there
    double openness = 0;         ///< share of the rays from there that leave the scene [-]
};

struct FreeSpace {
    /// The spaces that have a few places at least, the largest first. They keep to the box of the
    /// scene, without suns and skies.
    std::vector<Space> spaces;
    std::size_t places = 0;     ///< number of places, those of small spaces too
    double volume_of_place = 0; ///< local units
    /// Returns what can be looked at from all spaces, about two thousand places.
    [[nodiscard]] std::vector<SeenPlace> seen() const;
};

/// What of a scene is looked at: the box of its near facets, with some room around it where nothing
/// else is free, or in any case.
enum class Around { where_needed, always };
/// Finds the spaces; the same mesh gives the same ones.
[[nodiscard]] FreeSpace find_free_space(const Mesh& mesh, const Tracer& tracer,
                                        Around around = Around::where_needed);

} // namespace hemilux
