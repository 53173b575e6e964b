// The simple situation of the paper's figures 7 and 8: 1002 patches, large empty walls, and a small
// crowd on the table.

#include "furniture.h"
#include "scenes.h"

namespace hemilux {

SceneWriter make_room() {
    SceneWriter writer("room_1002");
    define_furniture_materials(writer);
    writer.group("room");
    add_room(writer, {6, 3, 5}, {10, 5, 8});
    writer.group("lamp");
    add_ceiling_lamp(writer, Placement(3.2, 3, 2.5), 1.2, .6, 4, 2);

    const Placement table = Placement(3.4, 0, 2.6).facing(12, 1);
    writer.group("table");
    add_table(writer, table, {1.5, .74, .8}, {5, 3}, 2);
    writer.group("chairs");
    add_chair(writer, Placement(3.3, 0, 1.95).facing(8, -1));
    writer.group("cupboard");
    add_cupboard(writer, Placement(1.3, 0, .27), {1.2, 1.7, .5}, {4, 4, 2});
    writer.group("boxes");
    writer.use("ochre");
    const Placement box = Placement(1.15, 1.7, .26).facing(9, 1);
    add_block(writer, box, {.7, .24, .36}, {3, 1, 2});
    writer.use("red");
    add_block(writer, box(Placement(.05, .24, 0).facing(6, -1)), {.4, .16, .26}, {2, 1, 1});
    writer.group("chest");
    writer.use("blue");
    add_block(writer, Placement(2.35, 0, .34).facing(10, -1), {.7, .45, .45}, {2, 2, 2});

    writer.group("detail_blocks");
    add_towers(writer, table(Placement(-.1, .74, 0)), 4, 4, .028, 3, 2);
    writer.group("detail_pencils");
    add_pencils(writer, table(Placement(.04, .74, .02)), 5, 4);
    return writer;
}

} // namespace hemilux
