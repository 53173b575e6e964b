#include "unseen_scenes.h"

#include "../examples/scenes/furniture.h"
#include "radiosity/paper/sampling/rng.h"

#include <algorithm>
#include <array>
#include <string>

namespace hemilux::bench {
namespace {

double between(Rng& rng, double low, double high) { return low + (high - low) * rng.uniform(); }

/// Walls and ceiling of any brightness; the first definition of a name counts.
void define_materials(SceneWriter& writer, Rng& rng) {
    writer.define({"wall", Vec3(between(rng, .35, .85)), {}});
    writer.define({"ceiling", Vec3(between(rng, .5, .85)), {}});
    writer.define({"floor", Vec3(between(rng, .15, .6)), {}});
    define_furniture_materials(writer);
}

// ---- walls

constexpr double room_width = 6, room_height = 3;
constexpr double wall_z = 1.3, wall_thickness = 0.1;

/// From `bottom` on, at the distance z from the wall behind what it hides.
void add_slab(SceneWriter& writer, double left, double right, double height, double bottom = 0,
              double z = wall_z) {
    const int columns = std::max(1, static_cast<int>((right - left) / .4));
    const int rows = std::max(1, static_cast<int>(height / .4));
    add_block(writer, Placement((left + right) / 2, bottom, z),
              {right - left, height, wall_thickness}, {columns, rows, 1});
}

void add_wall(SceneWriter& writer, Wall wall) {
    constexpr double left = gap, right = room_width - gap, high = room_height - gap;
    writer.group("obstacle");
    writer.use("cream");
    if (wall == Wall::screen)
        add_slab(writer, 1.3, 4.7, 2.4);
    if (wall == Wall::partition)
        add_slab(writer, left, room_width - 1.2, high);
    if (wall == Wall::half)
        add_slab(writer, left, right, 1.2);
    if (wall == Wall::gap) {
        add_slab(writer, left, 3.6, high);
        add_slab(writer, 4.1, right, high);
    }
}

void add_obstacle(SceneWriter& writer, Obstacle obstacle, Rng& rng) {
    constexpr double left = gap, right = room_width - gap, high = room_height - 2 * gap;
    const double z = between(rng, 1.3, 2.8);
    writer.group("obstacle");
    writer.use("cream");
    if (obstacle == Obstacle::partition) {
        const double opening = between(rng, .8, 2);
        rng.uniform() < .5 ? add_slab(writer, left, right - opening, high, 0, z)
                           : add_slab(writer, left + opening, right, high, 0, z);
    }
    if (obstacle == Obstacle::door) {
        constexpr double door_height = 2.05;
        const double width = between(rng, .8, 1.1), from = between(rng, .3, right - width - .3);
        add_slab(writer, left, from, high, 0, z);
        add_slab(writer, from + width, right, high, 0, z);
        add_slab(writer, from + gap, from + width - gap, high - door_height, door_height, z);
    }
    if (obstacle == Obstacle::screen) {
        const double width = between(rng, 1.4, 3.6), height = between(rng, 1.3, 2.5),
                     from = between(rng, .1, right - width - .1);
        add_slab(writer, from, from + width, height, 0, z);
    }
    if (obstacle == Obstacle::half)
        add_slab(writer, left, right, between(rng, .8, 1.6), 0, z);
}

void add_crowd(SceneWriter& writer, Rng& rng) {
    constexpr int boards = 5, columns = 11, rows = 2;
    constexpr double width = 2.4, depth = 0.4, pitch = 0.4;
    constexpr std::array colours{"red", "blue", "green", "ochre", "cream"};
    const double left = between(rng, .4, room_width - width - .4);
    writer.group("detail_crowd");
    for (int b = 0; b < boards; ++b) {
        const Placement board(left + width / 2, 0.2 + pitch * b, 0.6);
        writer.use("wood");
        writer.add_box(board, {{-width / 2, -0.02, -depth / 2}, {width, 0.02, depth}, {6, 1, 1}});
        for (int i = 0; i < columns; ++i)
            for (int j = 0; j < rows; ++j) {
                const Placement foot((i + .5) * width / columns - width / 2, 0,
                                     (j + .5) * depth / rows - depth / 2);
                writer.use(colours[rng.bits() % colours.size()]);
                const double height = between(rng, .1, .3), turn = between(rng, -.5, .5);
                add_block(writer, board(foot.facing(1, turn)), {0.11, height, 0.1});
            }
    }
}

void add_small_things(SceneWriter& writer, const Placement& table, double height, Rng& rng) {
    switch (rng.bits() % 3) {
    case 0:
        writer.group("detail_keyboard");
        add_keyboard(writer, table(Placement(0, height, .1)), 10, 3, between(rng, .018, .024));
        break;
    case 1:
        writer.group("detail_chess");
        add_chess(writer, table(Placement(0, height, 0)), between(rng, .025, .04), 10);
        break;
    default:
        writer.group("detail_towers");
        add_towers(writer, table(Placement(0, height, 0)), 4, 4, between(rng, .025, .04), 3,
                   rng.bits());
    }
    writer.group("detail_pencils");
    add_pencils(writer, table(Placement(.3, height, -.1)), 5, rng.bits());
}

void add_corner(SceneWriter& writer, Rng& rng) {
    const Placement table =
        Placement(between(rng, 1, 1.3), 0, .62).facing(12, between(rng, -1.0, 1.0));
    writer.group("table");
    add_table(writer, table, {1.4, .74, .8}, {5, 3}, 2);
    add_small_things(writer, table, .74, rng);
}

// ---- furnished rooms

void add_desk(SceneWriter& writer, const Placement& at, Rng& rng) {
    const double height = between(rng, .42, .76), width = between(rng, 1.1, 1.5);
    writer.group("tables");
    add_table(writer, at(Placement(0, 0, -.3)), {width, height, .75}, {5, 3}, 2);
    add_small_things(writer, at(Placement(0, 0, -.3)), height, rng);
    writer.group("chairs");
    const Placement sitter(0, 0, .45);
    rng.uniform() < .5 ? add_chair(writer, at(sitter.facing(-1, between(rng, -.3, .3))))
                       : add_office_chair(writer, at(sitter.facing(-1, between(rng, -.3, .3))));
}

/// Whatever fits into a place.
void add_piece(SceneWriter& writer, const Placement& at, Rng& rng) {
    writer.group("furniture");
    switch (rng.bits() % 8) {
    case 0:
    case 1:
        return add_desk(writer, at, rng);
    case 2:
        return add_sofa(writer, at);
    case 3:
        return add_cupboard(writer, at, {1.2, between(rng, .8, 1.9), .5}, {4, 4, 2});
    case 4:
        return add_bookshelf(writer, at, {1.2, 1.6, .32}, 4, rng.bits());
    case 5:
        return add_potted_tree(writer, at);
    case 6:
        writer.use("blue");
        return add_block(writer, at, {.8, between(rng, .4, 1.6), .6}, {3, 3, 2});
    default:
        return; // nothing
    }
}

} // namespace

SceneWriter make_wall_scene(Wall wall, Hidden hidden, std::uint64_t seed) {
    Rng rng(hash_words({0x3a11, seed}));
    SceneWriter writer(std::string("wall_") + wall_names[static_cast<std::size_t>(wall)] + "_" +
                       hidden_names[static_cast<std::size_t>(hidden)] + "_" + std::to_string(seed));
    define_materials(writer, rng);
    writer.group("room");
    add_room(writer, {room_width, room_height, 6}, {10, 5, 10});
    writer.group("lamp");
    add_ceiling_lamp(writer, Placement(between(rng, 1.5, 4.5), room_height, 3.6), 1.2, .9, 4, 3);
    hidden == Hidden::crowd ? add_crowd(writer, rng) : add_corner(writer, rng);
    add_wall(writer, wall);
    writer.group("chair");
    add_chair(writer, Placement(between(rng, 2, 4.5), 0, 3.6).facing(1, .3));
    return writer;
}

SceneWriter make_obstacle_scene(Obstacle obstacle, Hidden hidden, std::uint64_t seed) {
    const auto kind = static_cast<std::size_t>(obstacle), what = static_cast<std::size_t>(hidden);
    Rng rng(hash_words({0x0b57, kind, what, seed}));
    SceneWriter writer(std::string("obstacle_") + obstacle_names[kind] + "_" + hidden_names[what] +
                       "_" + std::to_string(seed));
    define_materials(writer, rng);
    writer.group("room");
    add_room(writer, {room_width, room_height, 6}, {10, 5, 10});
    writer.group("lamp");
    add_ceiling_lamp(writer, Placement(between(rng, 1, 5), room_height, between(rng, 3.6, 5.2)),
                     between(rng, .4, 1.2), between(rng, .3, .9), 4, 3);
    hidden == Hidden::crowd ? add_crowd(writer, rng) : add_corner(writer, rng);
    add_obstacle(writer, obstacle, rng);
    writer.group("chair");
    add_chair(writer, Placement(between(rng, 1, 5), 0, between(rng, 3.7, 5)).facing(1, .3));
    return writer;
}

SceneWriter make_furnished_room(std::uint64_t seed) {
    constexpr double place = 1.9;
    Rng rng(hash_words({0x4007, seed}));
    const int columns = 2 + static_cast<int>(rng.bits() % 3);
    const int rows = 2 + static_cast<int>(rng.bits() % 2);
    const Vec3 size(columns * place, between(rng, 2.5, 3.4), rows * place);
    SceneWriter writer("furnished_" + std::to_string(seed));
    define_materials(writer, rng);
    writer.group("room");
    add_room(writer, size, {4 * columns, 5, 4 * rows});
    writer.group("lamps");
    for (int lamp = 0, lamps = 1 + static_cast<int>(rng.bits() % 3); lamp < lamps; ++lamp)
        add_ceiling_lamp(
            writer, Placement(size.x * (lamp + .5) / lamps, size.y, between(rng, 1, size.z - 1)),
            between(rng, .4, 1.2), between(rng, .2, .8), 3, 2);
    const int of_desk = static_cast<int>(rng.bits() % static_cast<unsigned>(columns * rows));
    for (int k = 0; k < columns * rows; ++k) {
        const Placement at = Placement((k % columns + .5) * place, 0, (k / columns + .5) * place);
        const double turn = between(rng, -.08, .08);
        const Placement turned = rng.uniform() < .5 ? at.facing(1, turn) : at.facing(-1, turn);
        k == of_desk ? add_desk(writer, turned, rng) : add_piece(writer, turned, rng);
    }
    return writer;
}

} // namespace hemilux::bench
