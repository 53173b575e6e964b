#pragma once
// Finds where lamps would hang that light a space: under the ceiling, one in each room.
//
// Of places spread over the space, the one is taken from under whose ceiling most of the space can
// be seen, near ones more than far ones. So a lamp hangs about the middle of its room. What it sees
// is lit, and the next lamp is chosen for the rest, until hardly anything is left.

#include "radiosity/light/rooms/free_space.h"

#include <vector>

namespace hemilux {

/// A round lamp that shines downwards.
struct RoomLamp {
    Vec3 centre;   ///< local frame
    double radius; ///< local units
    double area;   ///< about that of the surfaces around what it lights, local units
};

/// Returns lamps for a space, so many at most; `up` is the axis that points upwards. None where the
/// space has no ceiling or no room for a lamp.
[[nodiscard]] std::vector<RoomLamp> lamps_of_space(const Mesh& mesh, const Tracer& tracer,
                                                   const Space& space, double volume_of_place,
                                                   int up, std::size_t max_lamps);

} // namespace hemilux
