#pragma once
// What the rooms are furnished with. Each object stands at the origin of its placement, its front
// towards +z; sizes are width (x), height (y), depth (z) in metres.
//
// Nothing touches: objects stand on feet of 2 mm and their parts keep the same distance, so that no
// patch is covered by another and no two surfaces coincide.

#include "scene_writer.h"

#include <cstdint>

namespace hemilux {

inline constexpr double gap = 0.002;

/// Materials under the names that the functions below use.
void define_furniture_materials(SceneWriter& writer);

/// A closed room, air inside: its corner at the origin. Materials `floor`, `ceiling`, `wall`.
void add_room(SceneWriter& writer, const Vec3& size, const std::array<int, 3>& divisions);
/// A box centred on the placement; feet of `lift`.
void add_block(SceneWriter& writer, const Placement& at, const Vec3& size,
               const std::array<int, 3>& divisions = {1, 1, 1}, double lift = gap);
/// A flat box below the ceiling (the placement), bottom emitting `lamp`.
void add_ceiling_lamp(SceneWriter& writer, const Placement& at, double width, double depth, int nx,
                      int nz);
void add_floor_lamp(SceneWriter& writer, const Placement& at);

/// `top`: divisions of its top; legs of `leg_rows` patches in height.
void add_table(SceneWriter& writer, const Placement& at, const Vec3& size,
               const std::array<int, 2>& top, int leg_rows);
void add_chair(SceneWriter& writer, const Placement& at);
void add_office_chair(SceneWriter& writer, const Placement& at);
void add_sofa(SceneWriter& writer, const Placement& at);
/// With two doors and their knobs.
void add_cupboard(SceneWriter& writer, const Placement& at, const Vec3& size,
                  const std::array<int, 3>& divisions);
/// With `boards` boards full of books.
void add_bookshelf(SceneWriter& writer, const Placement& at, const Vec3& size, int boards,
                   std::uint64_t seed);
void add_monitor(SceneWriter& writer, const Placement& at);
void add_potted_tree(SceneWriter& writer, const Placement& at);

/// Small things, patches of a few square millimetres to square centimetres: columns of little
/// boxes, each 1 to `floors` high.
void add_towers(SceneWriter& writer, const Placement& at, int columns, int rows, double pitch,
                int floors, std::uint64_t seed);
void add_keyboard(SceneWriter& writer, const Placement& at, int columns, int rows, double pitch);
void add_chess(SceneWriter& writer, const Placement& at, double field, int pieces);
/// Slender prisms standing close together.
void add_pencils(SceneWriter& writer, const Placement& at, int count, std::uint64_t seed);

} // namespace hemilux
