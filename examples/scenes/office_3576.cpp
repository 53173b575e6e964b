// The complex situation of the paper's figures 9 and 10: 3576 patches, an office with furniture on
// top of and beside furniture, several lamps, empty walls and small crowded places.

#include "furniture.h"
#include "scenes.h"

namespace hemilux {

namespace {

constexpr double desk_height = 0.74;

/// A desk with its drawers, monitor and chair; the sitter's side is +z.
void add_workplace(SceneWriter& writer, const Placement& at, double chair_turn) {
    writer.group("desks");
    add_table(writer, at, {1.6, desk_height, 0.8}, {5, 2}, 2);
    writer.use("grey");
    add_block(writer, at(Placement(0.48, 0, 0)), {0.4, 0.56, 0.6}, {2, 2, 2});
    writer.group("monitors");
    add_monitor(writer, at(Placement(0, desk_height, -0.2)));
    writer.group("chairs");
    add_office_chair(writer, at(Placement(-0.1, 0, 0.7).facing(-1, chair_turn)));
}

void add_desk_island(SceneWriter& writer) {
    const double spacing = 1.66;
    const Placement near_left(3.2, 0, 3.5), near_right(3.2 + spacing, 0, 3.5);
    add_workplace(writer, near_left, 0.25);
    add_workplace(writer, near_right, -0.6);
    add_workplace(writer, Placement(3.2, 0, 2.66).facing(-1, 0), -0.1);

    writer.group("detail_keyboard");
    add_keyboard(writer, near_right(Placement(0, desk_height, 0.12)), 12, 3, 0.019);
    writer.group("detail_pencils");
    add_pencils(writer, near_right(Placement(-0.5, desk_height, 0.1)), 6, 7);
    writer.group("papers");
    writer.use("cream");
    add_block(writer, near_left(Placement(-0.45, desk_height, 0.12).facing(5, 1)),
              {0.21, 0.03, 0.3}, {2, 1, 3});
    writer.use("red");
    add_block(writer, near_right(Placement(0.5, desk_height, 0.05).facing(5, -1)),
              {0.22, 0.08, 0.3}, {2, 1, 3});
}

void add_back_wall(SceneWriter& writer) {
    writer.group("bookshelf");
    add_bookshelf(writer, Placement(1.9, 0, 0.18), {1.3, 1.6, 0.32}, 4, 4);
    writer.group("cupboards");
    for (const double x : {3.3, 4.52})
        add_cupboard(writer, Placement(x, 0, 0.25), {1.2, 0.9, 0.46}, {4, 3, 2});
    writer.group("boxes");
    writer.use("ochre");
    const Placement box = Placement(3.2, 0.9, 0.22).facing(9, 1);
    add_block(writer, box, {0.5, 0.26, 0.36}, {2, 1, 2});
    writer.use("blue");
    add_block(writer, box(Placement(0, 0.26, 0).facing(7, -1)), {0.36, 0.2, 0.28}, {2, 1, 2});
    writer.use("grey");
    add_block(writer, Placement(4.6, 0.9, 0.24), {0.46, 0.3, 0.38}, {2, 2, 2});
    writer.group("whiteboard");
    writer.use("ceiling");
    writer.add_box({}, {{5.4, 1.05, gap}, {1.8, 1.1, 0.02}, {4, 3, 1}});
}

void add_sitting_corner(SceneWriter& writer) {
    writer.group("sofa");
    add_sofa(writer, Placement(0.55, 0, 2.7).facing(0, -1));
    writer.group("coffee_table");
    const Placement table(1.5, 0, 2.7);
    add_table(writer, table, {0.6, 0.42, 0.9}, {3, 4}, 1);
    writer.group("detail_chess");
    add_chess(writer, table(Placement(0, 0.42, 0.05).facing(4, 1)), 0.035, 12);
    writer.group("picture");
    writer.use("dark_wood");
    writer.add_box({}, {{gap, 1.3, 2.1}, {0.02, 0.8, 1.2}, {1, 3, 4}}, all_faces - face_right);
    writer.use("blue");
    writer.add_box({}, {{gap, 1.3, 2.1}, {0.02, 0.8, 1.2}, {1, 3, 4}}, face_right);
    writer.group("floor_lamp");
    add_floor_lamp(writer, Placement(0.4, 0, 4.0));
    writer.group("plants");
    add_potted_tree(writer, Placement(0.5, 0, 1.2));
    writer.group("door");
    writer.use("wood");
    writer.add_box({}, {{gap, gap, 4.5}, {0.03, 2.05, 0.9}, {1, 5, 2}});
}

} // namespace

SceneWriter make_office() {
    SceneWriter writer("office_3576");
    define_furniture_materials(writer);
    writer.group("room");
    add_room(writer, {8, 3, 6}, {14, 5, 10});
    writer.group("ceiling_lamps");
    for (const double x : {2.3, 4.3, 6.3})
        add_ceiling_lamp(writer, Placement(x, 3, 3).facing(0, 1), 1.6, 0.3, 4, 2);
    add_desk_island(writer);
    add_back_wall(writer);
    add_sitting_corner(writer);
    return writer;
}

} // namespace hemilux
