#pragma once
// A room as it is modelled in Blender and written by its OBJ exporter: a cube, whose normals point
// outwards, a plane as lamp, whose normal points upwards, and a sphere on the floor.

#include <cstdint>
#include <string>

namespace hemilux::test {

enum class Facing {
    as_modelled, ///< walls outwards, lamp upwards, sphere outwards
    right,       ///< walls inwards, lamp downwards, sphere outwards
    all_turned,  ///< the contrary of as modelled
    half_turned  ///< as modelled, a random half of the faces turned
};

/// The text of an OBJ file with v, vt and vn lines, which names `room.mtl`. `seed`: of half_turned.
[[nodiscard]] std::string blender_room(Facing facing, std::uint64_t seed = 1);
/// The text of room.mtl: materials Wall, Lamp and Clay.
[[nodiscard]] std::string blender_materials();

} // namespace hemilux::test
