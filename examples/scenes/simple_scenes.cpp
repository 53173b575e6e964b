// Scenes whose answer is known: the two furnaces and the cube.

#include "scenes.h"

namespace hemilux {

namespace {

/// The L-shaped plan: `cells` squares a side, of which the quarter at high x and z is missing.
class LPlan {
  public:
    static constexpr int cells = 6;
    static constexpr double cell_size = 0.5, height = 2;
    static constexpr int rows = 4;

    static bool inside(int i, int k) {
        const bool on_plan = i >= 0 && k >= 0 && i < cells && k < cells;
        return on_plan && (i < cells / 2 || k < cells / 2);
    }
    static Vec3 corner(int i, int k) { return {i * cell_size, 0, k * cell_size}; }
};

/// The wall of `rows` patches that stands on the floor edge a -> b; the air is to its left.
void add_wall(SceneWriter& writer, const Vec3& a, const Vec3& b) {
    writer.add_grid({}, b, a - b, {0, LPlan::height, 0}, 1, LPlan::rows);
}

} // namespace

SceneWriter make_furnace_box() {
    SceneWriter writer("furnace_box");
    writer.define({"furnace", Vec3(0.5), Vec3(1.0)});
    writer.use("furnace");
    writer.add_box({}, {Vec3(0.0), {4, 2.5, 3}, {5, 5, 5}}, all_faces, BoxAir::inside);
    return writer;
}

SceneWriter make_furnace_lshape() {
    SceneWriter writer("furnace_lshape");
    writer.define({"furnace", Vec3(0.5), Vec3(1.0)});
    writer.use("furnace");
    const Vec3 x(LPlan::cell_size, 0, 0), z(0, 0, LPlan::cell_size), up(0, LPlan::height, 0);
    for (int i = 0; i < LPlan::cells; ++i)
        for (int k = 0; k < LPlan::cells; ++k) {
            if (!LPlan::inside(i, k))
                continue;
            const Vec3 c = LPlan::corner(i, k);
            writer.add_grid({}, c, z, x, 1, 1);      // floor
            writer.add_grid({}, c + up, x, z, 1, 1); // ceiling
            if (!LPlan::inside(i - 1, k))
                add_wall(writer, c, c + z);
            if (!LPlan::inside(i + 1, k))
                add_wall(writer, c + x + z, c + x);
            if (!LPlan::inside(i, k - 1))
                add_wall(writer, c + x, c);
            if (!LPlan::inside(i, k + 1))
                add_wall(writer, c + z, c + x + z);
        }
    return writer;
}

namespace {

SceneWriter make_cube(std::string name, int n) {
    SceneWriter writer(std::move(name));
    writer.define({"floor", Vec3(0.5), Vec3(1.0)});
    writer.define({"wall", Vec3(0.5), Vec3(0.0)});
    const BoxShape cube{Vec3(0.0), Vec3(1.0), {n, n, n}};
    writer.use("floor");
    writer.add_box({}, cube, face_bottom, BoxAir::inside);
    writer.use("wall");
    writer.add_box({}, cube, all_faces - face_bottom, BoxAir::inside);
    return writer;
}

} // namespace

SceneWriter make_cube() { return make_cube("cube_96", 4); }
SceneWriter make_cube_of_six() { return make_cube("cube_6", 1); }

} // namespace hemilux
