// Under the open sky: a square with blocks and a street lamp. Most rays escape, so densities of 0
// and rows of form factors that sum to far less than 1.

#include "furniture.h"
#include "scenes.h"

namespace hemilux {

SceneWriter make_open_scene() {
    SceneWriter writer("open_scene");
    define_furniture_materials(writer);
    writer.group("ground");
    writer.use("wall");
    writer.add_grid({}, {-5, 0, -5}, {0, 0, 10}, {10, 0, 0}, 16, 16);

    writer.group("blocks");
    writer.use("red");
    add_block(writer, Placement(-1.8, 0, -1.6).facing(5, -1), {1.6, 2.2, 1.4}, {4, 6, 4});
    writer.use("cream");
    const Placement low = Placement(1.2, 0, -1.8).facing(7, 2);
    add_block(writer, low, {2.2, 1.0, 1.2}, {6, 3, 3});
    writer.use("blue");
    add_block(writer, low(Placement(.3, 1.0, 0).facing(3, -1)), {.8, .8, .8}, {3, 3, 3});

    writer.group("bench");
    const Placement bench = Placement(.2, 0, 1.0).facing(6, 1);
    add_table(writer, bench, {1.6, .45, .5}, {6, 2}, 2);
    writer.group("lamp");
    writer.use("metal");
    // It ends well below the lantern: a small cap right under it would be so bright that the error
    // of the whole scene would be its own.
    writer.add_prism(Placement(1.7, gap, .6), {.06, .04, 2.0, 8, 6});
    writer.use("lamp");
    writer.add_prism(Placement(1.7, 2.21, .6), {.12, .2, .3, 8});

    writer.group("detail_blocks");
    add_towers(writer, bench(Placement(.1, .45, 0)), 4, 4, .04, 3, 2);
    return writer;
}

} // namespace hemilux
