#include "furniture.h"

#include "radiosity/paper/sampling/rng.h"

namespace hemilux {

namespace {

double between(Rng& rng, double low, double high) { return low + (high - low) * rng.uniform(); }

/// A box between two heights, centred on the placement.
void add_slab(SceneWriter& writer, const Placement& at, double width, double depth, double bottom,
              double top, const std::array<int, 3>& divisions) {
    writer.add_box(at, {{-width / 2, bottom, -depth / 2}, {width, top - bottom, depth}, divisions});
}

void add_four_legs(SceneWriter& writer, const Placement& at, const Vec3& size, double thickness,
                   int rows) {
    const double inset = thickness / 2 + 0.02;
    for (const double x : {-1.0, 1.0})
        for (const double z : {-1.0, 1.0}) {
            const Placement corner(x * (size.x / 2 - inset), 0, z * (size.z / 2 - inset));
            add_slab(writer, at(corner), thickness, thickness, gap, size.y - gap, {1, rows, 1});
        }
}

constexpr std::array book_colours{"red", "blue", "cream", "green", "ochre", "grey"};

void add_books(SceneWriter& writer, const Placement& at, double width, Rng& rng) {
    double x = -width / 2 + gap;
    for (std::size_t i = 0;; ++i) {
        const double thickness = between(rng, 0.035, 0.08), height = between(rng, 0.2, 0.28);
        const double depth = between(rng, 0.17, 0.21), pause = i % 7 == 6 ? 0.09 : gap;
        if (x + thickness + gap > width / 2)
            return;
        writer.use(book_colours[rng.bits() % book_colours.size()]);
        add_block(writer, at(Placement(x + thickness / 2, 0, (depth - 0.21) / 2)),
                  {thickness, height, depth});
        x += thickness + pause;
    }
}

} // namespace

void define_furniture_materials(SceneWriter& writer) {
    writer.define({"wall", {.72, .70, .66}, {}});
    writer.define({"floor", {.42, .36, .30}, {}});
    writer.define({"ceiling", {.78, .78, .77}, {}});
    writer.define({"wood", {.52, .36, .22}, {}});
    writer.define({"dark_wood", {.34, .24, .20}, {}});
    writer.define({"metal", {.48, .48, .50}, {}});
    writer.define({"plastic", {.22, .22, .24}, {}});
    writer.define({"cloth", {.24, .32, .46}, {}});
    writer.define({"red", {.62, .22, .20}, {}});
    writer.define({"blue", {.22, .30, .58}, {}});
    writer.define({"green", {.26, .50, .28}, {}});
    writer.define({"ochre", {.66, .50, .22}, {}});
    writer.define({"cream", {.74, .68, .56}, {}});
    writer.define({"grey", {.46, .46, .46}, {}});
    writer.define({"screen", {.20, .20, .20}, {.12, .18, .30}});
    writer.define({"shade", {.60, .56, .46}, {6., 4.5, 2.8}});
    writer.define({"lamp", {.70, .70, .70}, {20., 19., 17.}});
}

void add_room(SceneWriter& writer, const Vec3& size, const std::array<int, 3>& divisions) {
    const BoxShape shape{Vec3(0.0), size, divisions};
    writer.use("floor");
    writer.add_box({}, shape, face_bottom, BoxAir::inside);
    writer.use("ceiling");
    writer.add_box({}, shape, face_top, BoxAir::inside);
    writer.use("wall");
    writer.add_box({}, shape, face_left | face_right | face_back | face_front, BoxAir::inside);
}

void add_block(SceneWriter& writer, const Placement& at, const Vec3& size,
               const std::array<int, 3>& divisions, double lift) {
    add_slab(writer, at, size.x, size.z, lift, size.y, divisions);
}

void add_ceiling_lamp(SceneWriter& writer, const Placement& at, double width, double depth, int nx,
                      int nz) {
    const double thickness = 0.06;
    const BoxShape shape{
        {-width / 2, -gap - thickness, -depth / 2}, {width, thickness, depth}, {nx, 1, nz}};
    writer.use("lamp");
    writer.add_box(at, shape, face_bottom);
    writer.use("ceiling");
    writer.add_box(at, shape, all_faces - face_bottom);
}

void add_floor_lamp(SceneWriter& writer, const Placement& at) {
    writer.use("metal");
    writer.add_prism(at(Placement(0, gap, 0)), {0.15, 0.14, 0.02, 12});
    writer.add_prism(at(Placement(0, 0.03, 0)), {0.015, 0.015, 1.35, 6, 3});
    writer.use("shade");
    writer.add_prism(at(Placement(0, 1.39, 0)), {0.2, 0.13, 0.26, 12, 2});
}

void add_table(SceneWriter& writer, const Placement& at, const Vec3& size,
               const std::array<int, 2>& top, int leg_rows) {
    const double thickness = 0.035;
    writer.use("wood");
    add_slab(writer, at, size.x, size.z, size.y - thickness, size.y, {top[0], 1, top[1]});
    writer.use("dark_wood");
    add_four_legs(writer, at, size - Vec3(0, thickness, 0), 0.05, leg_rows);
}

void add_chair(SceneWriter& writer, const Placement& at) {
    writer.use("dark_wood");
    add_slab(writer, at, 0.42, 0.42, 0.42, 0.46, {3, 1, 3});
    add_slab(writer, at(Placement(0, 0, -0.19)), 0.42, 0.03, 0.46 + gap, 0.92, {3, 3, 1});
    add_four_legs(writer, at, {0.42, 0.42, 0.42}, 0.04, 2);
}

void add_office_chair(SceneWriter& writer, const Placement& at) {
    writer.use("plastic");
    writer.add_prism(at(Placement(0, gap, 0)), {0.27, 0.2, 0.05, 8});
    writer.add_prism(at(Placement(0, 0.055, 0)), {0.03, 0.03, 0.36, 6});
    writer.use("cloth");
    add_slab(writer, at, 0.46, 0.44, 0.42, 0.49, {3, 1, 3});
    add_slab(writer, at(Placement(0, 0, -0.2)), 0.42, 0.04, 0.55, 0.98, {3, 3, 1});
    writer.use("plastic");
    add_slab(writer, at(Placement(0, 0, -0.23)), 0.06, 0.012, 0.44, 0.8, {1, 2, 1});
}

void add_sofa(SceneWriter& writer, const Placement& at) {
    writer.use("cloth");
    add_block(writer, at(Placement(0, 0, 0.05)), {1.3, 0.32, 0.68}, {4, 1, 2}, 0.06);
    add_slab(writer, at(Placement(0, 0, -0.36)), 1.66, 0.12, 0.06, 0.78, {5, 3, 1});
    for (const double x : {-0.74, 0.74})
        add_slab(writer, at(Placement(x, 0, 0.05)), 0.17, 0.68, 0.06, 0.56, {1, 2, 3});
    for (const double x : {-0.32, 0.32})
        add_slab(writer, at(Placement(x, 0, 0.05)), 0.62, 0.66, 0.32 + gap, 0.44, {3, 1, 3});
    writer.use("ochre");
    add_slab(writer, at(Placement(-0.42, 0.442, -0.1).facing(4, 1)), 0.36, 0.1, gap, 0.34,
             {2, 2, 1});
}

void add_cupboard(SceneWriter& writer, const Placement& at, const Vec3& size,
                  const std::array<int, 3>& divisions) {
    writer.use("wood");
    add_block(writer, at, size, divisions);
    const double door_width = size.x / 2 - 0.015, front = size.z / 2 + gap;
    for (const double side : {-1.0, 1.0}) {
        const Placement door = at(Placement(side * size.x / 4, 0, front + 0.01));
        writer.use("cream");
        add_slab(writer, door, door_width, 0.02, 0.06, size.y - 0.03,
                 {divisions[0] / 2, divisions[1], 1});
        writer.use("metal");
        add_slab(writer, door(Placement(-side * (door_width / 2 - 0.05), size.y / 2, 0.025)), 0.025,
                 0.025, 0, 0.025, {1, 1, 1});
    }
}

void add_bookshelf(SceneWriter& writer, const Placement& at, const Vec3& size, int boards,
                   std::uint64_t seed) {
    const double plank = 0.02;
    writer.use("dark_wood");
    for (const double side : {-1.0, 1.0})
        add_slab(writer, at(Placement(side * (size.x - plank) / 2, 0, 0)), plank, size.z, gap,
                 size.y, {1, boards, 1});
    const double inner = size.x - 2 * plank - 2 * gap;
    add_slab(writer, at(Placement(0, 0, -(size.z - plank) / 2)), inner, plank, gap, size.y,
             {4, boards, 1});
    Rng rng(seed);
    for (int i = 0; i < boards; ++i) {
        const double height = 0.06 + (size.y - 0.1) * i / boards;
        const Placement board = at(Placement(0, height, plank / 2 + gap));
        writer.use("dark_wood");
        add_slab(writer, board, inner, size.z - plank - 2 * gap, -plank, 0, {4, 1, 1});
        add_books(writer, board, inner, rng);
    }
}

void add_monitor(SceneWriter& writer, const Placement& at) {
    writer.use("plastic");
    add_slab(writer, at, 0.22, 0.16, gap, 0.016, {2, 1, 1});
    add_slab(writer, at(Placement(0, 0, -0.04)), 0.05, 0.03, 0.018, 0.22, {1, 1, 1});
    const BoxShape panel{{-0.27, 0.1, 0.0}, {0.54, 0.33, 0.03}, {5, 3, 1}};
    writer.add_box(at, panel, all_faces - face_front);
    writer.use("screen");
    writer.add_box(at, panel, face_front);
}

void add_potted_tree(SceneWriter& writer, const Placement& at) {
    writer.use("red");
    writer.add_prism(at(Placement(0, gap, 0)), {0.13, 0.18, 0.32, 8, 2});
    writer.use("dark_wood");
    writer.add_prism(at(Placement(0, 0.33, 0)), {0.03, 0.03, 0.3, 6});
    writer.use("green");
    for (int i = 0; i < 3; ++i) {
        const double radius = 0.32 - 0.07 * i;
        writer.add_prism(at(Placement(0, 0.64 + 0.32 * i, 0).facing(4, i)),
                         {radius, 0.4 * radius, 0.31, 8, 2});
    }
}

void add_towers(SceneWriter& writer, const Placement& at, int columns, int rows, double pitch,
                int floors, std::uint64_t seed) {
    const double slit = 0.0005;
    Rng rng(seed);
    for (int i = 0; i < columns; ++i)
        for (int j = 0; j < rows; ++j) {
            const Vec3 foot((i - 0.5 * (columns - 1)) * pitch, 0, (j - 0.5 * (rows - 1)) * pitch);
            const int floor_count = 1 + static_cast<int>(floors * rng.uniform());
            double edge = pitch * between(rng, 0.55, 0.66), y = 0;
            for (int k = 0; k < floor_count; ++k, edge *= 0.86) {
                writer.use(book_colours[rng.bits() % book_colours.size()]);
                const double height = edge * between(rng, 0.6, 1.0);
                const double depth = edge * between(rng, 0.8, 1.0);
                const double turn = between(rng, -0.4, 0.4);
                add_block(writer, at(Placement(foot + Vec3(0, y, 0)).facing(1, turn)),
                          {edge, height, depth}, {1, 1, 1}, slit);
                y += height;
            }
        }
}

void add_keyboard(SceneWriter& writer, const Placement& at, int columns, int rows, double pitch) {
    const double base = 0.012;
    writer.use("plastic");
    add_block(writer, at, {(columns + 1) * pitch, base, (rows + 1) * pitch}, {4, 1, 2});
    writer.use("cream");
    for (int i = 0; i < columns; ++i)
        for (int j = 0; j < rows; ++j)
            add_block(writer,
                      at(Placement((i - 0.5 * (columns - 1)) * pitch, base,
                                   (j - 0.5 * (rows - 1)) * pitch)),
                      {0.8 * pitch, 0.4 * pitch, 0.8 * pitch}, {1, 1, 1}, 0.001);
}

void add_chess(SceneWriter& writer, const Placement& at, double field, int pieces) {
    const double height = 0.012, half = 4 * field;
    const BoxShape board{{-half, gap, -half}, {2 * half, height - gap, 2 * half}, {8, 1, 8}};
    writer.use("dark_wood");
    writer.add_box(at, board, all_faces - face_top);
    const auto corner = [&](int i, int j) {
        return Vec3(i * field - half, height, j * field - half);
    };
    for (int i = 0; i < 8; ++i)
        for (int j = 0; j < 8; ++j) {
            writer.use((i + j) % 2 == 0 ? "cream" : "dark_wood");
            writer.add_grid(at, corner(i, j), {0, 0, field}, {field, 0, 0}, 1, 1);
        }
    for (int k = 0; k < pieces; ++k) {
        // Multiples of 19 visit each of the 64 fields once.
        const int square = k * 19 % 64;
        const Placement foot =
            at(Placement(corner(square / 8, square % 8)))(Placement(field / 2, 0.001, field / 2));
        writer.use(k % 2 == 0 ? "cream" : "plastic");
        const double body = field * (1.0 + 0.1 * (k % 4));
        writer.add_prism(foot, {0.34 * field, 0.18 * field, body, 6, 2});
        writer.add_prism(foot(Placement(0, body + 0.001, 0)),
                         {0.2 * field, 0.1 * field, 0.35 * field, 4});
    }
}

void add_pencils(SceneWriter& writer, const Placement& at, int count, std::uint64_t seed) {
    Rng rng(seed);
    for (int i = 0; i < count; ++i) {
        writer.use(book_colours[static_cast<std::size_t>(i) % book_colours.size()]);
        const Placement foot(0.013 * (i % 4), 0.001, 0.013 * (i / 4) + 0.006 * (i % 2));
        const double length = between(rng, 0.03, 0.06), turn = between(rng, -1, 1);
        writer.add_prism(at(foot).facing(1, turn), {0.0045, 0.004, length, 6, 2});
    }
}

} // namespace hemilux
