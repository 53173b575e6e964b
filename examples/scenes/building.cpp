// Six furnished rooms, two rows of three, with open doors between them and a lamp in each: what
// lights one of them is mostly its own lamp, and a little comes through the doors.

#include "furniture.h"
#include "scenes.h"

namespace hemilux {
namespace {

constexpr int columns = 3, rows = 2;
constexpr double width = 4, height = 2.8, wall_thickness = 0.2, pitch = width + wall_thickness;

/// Walls are 8 x 4 patches, a door takes two by three of them in the middle.
constexpr double cell = width / 8, row = height / 4;
constexpr double door_left = 3 * cell, door_width = 2 * cell, door_height = 3 * row;

const Vec3 up(0, 1, 0);

/// A wall from `left` along the unit vector `along`, seen from its front.
void add_wall(SceneWriter& writer, const Vec3& left, const Vec3& along, bool has_door) {
    if (!has_door) {
        writer.add_grid({}, left, width * along, height * up, 8, 4);
        return;
    }
    const Vec3 right = left + (door_left + door_width) * along;
    writer.add_grid({}, left, door_left * along, height * up, 3, 4);
    writer.add_grid({}, right, door_left * along, height * up, 3, 4);
    writer.add_grid({}, left + door_left * along + door_height * up, door_width * along,
                    (height - door_height) * up, 2, 1);
}

/// What is seen within the opening of a wall that begins at `left`; `through`: across it.
void add_door(SceneWriter& writer, const Vec3& left, const Vec3& along, const Vec3& through) {
    const Vec3 low = left + door_left * along, across = wall_thickness * through;
    const Vec3 wide = door_width * along, high = door_height * up;
    writer.add_grid({}, low, across, high, 1, 3);
    writer.add_grid({}, low + wide, high, across, 3, 1);
    writer.add_grid({}, low, wide, across, 2, 1);
    writer.add_grid({}, low + high, across, wide, 1, 2);
}

void furnish(SceneWriter& writer, const Placement& at, std::uint64_t room) {
    add_table(writer, at(Placement(2.1, 0, 2.5).facing(12, 1)), {1.4, 0.74, 0.8}, {4, 2}, 1);
    add_chair(writer, at(Placement(2.1, 0, 1.8).facing(8, -1)));
    add_chair(writer, at(Placement(2, 0, 3.2).facing(-8, 1)));
    add_cupboard(writer, at(Placement(0.8, 0, 0.27)), {1, 1.7, 0.5}, {3, 4, 2});
    add_bookshelf(writer, at(Placement(3.2, 0, 0.18)), {1, 1.6, 0.32}, 3, room);
    writer.use("blue");
    add_block(writer, at(Placement(0.6, 0, 3.3).facing(10, -1)), {0.7, 0.45, 0.45}, {2, 2, 2});
}

void add_room_of_building(SceneWriter& writer, int column, int row_of_rooms) {
    const int number = 1 + column + columns * row_of_rooms;
    const Vec3 low(pitch * column, 0, pitch * row_of_rooms);
    const Vec3 x(1, 0, 0), z(0, 0, 1), high = low + Vec3(width, 0, width);
    writer.group("room_" + std::to_string(number));
    writer.use("floor");
    writer.add_grid({}, low, width * z, width * x, 8, 8);
    writer.use("ceiling");
    writer.add_grid({}, low + height * up, width * x, width * z, 8, 8);
    writer.use("wall");
    const bool is_middle = column == 1;
    add_wall(writer, low, x, is_middle && row_of_rooms > 0);
    add_wall(writer, high, -x, is_middle && row_of_rooms + 1 < rows);
    add_wall(writer, {high.x, 0, low.z}, z, column + 1 < columns);
    add_wall(writer, {low.x, 0, high.z}, -z, column > 0);
    if (column + 1 < columns)
        add_door(writer, {high.x, 0, low.z}, z, x);
    if (is_middle && row_of_rooms + 1 < rows)
        add_door(writer, high, -x, z);
    furnish(writer, Placement(low), std::uint64_t(number));
    writer.group("lamps");
    add_ceiling_lamp(writer, Placement(low + Vec3(2, height, 2)), 0.8, 0.4, 2, 1);
}

} // namespace

SceneWriter make_building() {
    SceneWriter writer("building_6");
    define_furniture_materials(writer);
    for (int row_of_rooms = 0; row_of_rooms < rows; ++row_of_rooms)
        for (int column = 0; column < columns; ++column)
            add_room_of_building(writer, column, row_of_rooms);
    return writer;
}

} // namespace hemilux
