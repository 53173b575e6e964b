#pragma once
// Chooses a light for a scene that has none, or none where somebody can look: a sky and a sun where
// it is open, else a lamp in each room. What is hollow within a thing under the sky is no room,
// unless somebody looks into it.

#include "radiosity/light/rooms/free_space.h"
#include "radiosity/light/rooms/room_lamps.h"

#include <optional>
#include <vector>

namespace hemilux {

struct DefaultLight {
    bool sky = false; ///< and a sun
    Vec3 sun{0.0};    ///< direction in which its light goes, in world units
    std::vector<RoomLamp> lamps;
};

/// Chooses a light; `up` is the axis that points upwards. With `rooms_too`, rooms in a scene that
/// is open get lamps as well. The same mesh gives the same light.
[[nodiscard]] DefaultLight choose_default_light(const Mesh& mesh, const Tracer& tracer,
                                                const FreeSpace& free, int up,
                                                bool rooms_too = false);

} // namespace hemilux
