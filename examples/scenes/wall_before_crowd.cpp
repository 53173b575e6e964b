// The failure that the paper's conclusion names: a wall in front of a large number of surfaces. The
// density rays count the crowd through the screen, the energy rays end on the screen.

#include "furniture.h"
#include "scenes.h"

#include "radiosity/paper/sampling/rng.h"

namespace hemilux {

namespace {

/// Boards one above the other, crowded with boxes.
void add_crowd(SceneWriter& writer, const Placement& at) {
    constexpr int boards = 5, columns = 11, rows = 2;
    constexpr double width = 2.4, depth = 0.4, pitch = 0.4;
    constexpr std::array colours{"red", "blue", "green", "ochre", "cream"};
    Rng rng(1);
    for (int b = 0; b < boards; ++b) {
        const Placement board = at(Placement(0, 0.2 + pitch * b, 0));
        writer.use("wood");
        writer.add_box(board, {{-width / 2, -0.02, -depth / 2}, {width, 0.02, depth}, {6, 1, 1}});
        for (int i = 0; i < columns; ++i)
            for (int j = 0; j < rows; ++j) {
                const double x = (i + 0.5) * width / columns - width / 2;
                const double z = (j + 0.5) * depth / rows - depth / 2;
                writer.use(colours[rng.bits() % colours.size()]);
                const double height = 0.1 + 0.2 * rng.uniform(), turn = rng.uniform() - 0.5;
                add_block(writer, board(Placement(x, 0, z).facing(1, turn)), {0.11, height, 0.1});
            }
    }
}

} // namespace

SceneWriter make_wall_before_crowd() {
    SceneWriter writer("wall_before_crowd");
    define_furniture_materials(writer);
    writer.group("room");
    add_room(writer, {6, 3, 6}, {10, 5, 10});
    writer.group("lamp");
    add_ceiling_lamp(writer, Placement(3, 3, 3.6), 1.2, 1.2, 4, 4);
    writer.group("screen");
    writer.use("cream");
    add_block(writer, Placement(3, 0, 1.2), {3.4, 2.4, 0.1}, {8, 6, 1});
    writer.group("detail_crowd");
    add_crowd(writer, Placement(3, 0, 0.6));
    writer.group("chair");
    add_chair(writer, Placement(3.9, 0, 3.4).facing(1, 0.3));
    return writer;
}

} // namespace hemilux
