#pragma once
// Scenes that no default of hemilux has been chosen by: a family of walls before small things, and
// rooms that are furnished by chance. Faces are patches; groups of small things are named
// detail...

#include "../examples/scenes/scene_writer.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace hemilux::bench {

enum class Wall : std::size_t {
    none,
    screen,    ///< 3.4 m wide and 2.4 m high
    partition, ///< to the ceiling, from one wall of the room to 1.2 m before the other
    gap,       ///< to the ceiling and from wall to wall, but for a gap of 0.5 m
    half       ///< from wall to wall, 1.2 m high
};

/// What the wall hides.
enum class Hidden : std::size_t {
    crowd, ///< boards full of boxes of 0.1 m
    corner ///< a table in the corner with towers of little boxes, and pencils
};

/// What stands before hidden things in a room of chance: each anywhere and of any size of its kind.
enum class Obstacle : std::size_t {
    partition, ///< to the ceiling, from one wall of the room to 0.8 to 2 m before the other
    door,      ///< to the ceiling and from wall to wall, but for a door
    screen,    ///< 1.4 to 3.6 m wide and 1.3 to 2.5 m high
    half       ///< from wall to wall, 0.8 to 1.6 m high
};

inline constexpr std::array wall_names{"none", "screen", "partition", "gap", "half"};
inline constexpr std::array hidden_names{"crowd", "corner"};
inline constexpr std::array obstacle_names{"partition", "door", "screen", "half"};

/// A room of 6 x 3 x 6 m whose lamp is in front of the wall. The seed turns and moves what is
/// hidden, and chooses the brightness of the walls. Its name
/// is wall_KIND_HIDDEN_SEED.
[[nodiscard]] SceneWriter make_wall_scene(Wall wall, Hidden hidden, std::uint64_t seed);

/// The same room with an obstacle whose place, size and openings are the seed's, too. Its name is
/// obstacle_KIND_HIDDEN_SEED.
[[nodiscard]] SceneWriter make_obstacle_scene(Obstacle obstacle, Hidden hidden, std::uint64_t seed);

/// A room of chance: its size, brightness and lamps, and what stands in each place of 1.9 x 1.9 m,
/// with small things on the tables. There is one table at least. Its
/// name is furnished_SEED.
[[nodiscard]] SceneWriter make_furnished_room(std::uint64_t seed);

} // namespace hemilux::bench
