// The box of Goral et al. 1984 in the form that Cornell University measured, sides made parallel;
// colours are the usual RGB approximations of the measured spectra. The front (z = .56) is open.

#include "furniture.h"
#include "scenes.h"

namespace hemilux {

SceneWriter make_cornell_box() {
    SceneWriter writer("cornell_box");
    define_furniture_materials(writer);
    writer.define({"white", {.725, .71, .68}, {}});
    writer.define({"red_wall", {.63, .065, .05}, {}});
    writer.define({"green_wall", {.14, .45, .091}, {}});
    writer.define({"light", {.78, .78, .78}, {17, 12, 4}});

    const BoxShape box{Vec3(0.0), {.55, .55, .56}, {11, 11, 11}};
    writer.group("box");
    writer.use("white");
    writer.add_box({}, box, face_bottom | face_top | face_back, BoxAir::inside);
    writer.use("red_wall");
    writer.add_box({}, box, face_left, BoxAir::inside);
    writer.use("green_wall");
    writer.add_box({}, box, face_right, BoxAir::inside);

    writer.group("lamp");
    const BoxShape lamp{{.207, .543, .228}, {.13, .006, .105}, {4, 1, 4}};
    writer.use("light");
    writer.add_box({}, lamp, face_bottom);
    writer.use("white");
    writer.add_box({}, lamp, all_faces - face_bottom);

    writer.group("tall_block");
    add_block(writer, Placement(.1815, 0, .2085).facing(158, -49), {.165, .33, .165}, {4, 8, 4},
              .001);
    writer.group("short_block");
    const Placement short_block = Placement(.3645, 0, .391).facing(160, 48);
    add_block(writer, short_block, {.165, .165, .165}, {4, 4, 4}, .001);

    writer.group("detail_pile");
    add_towers(writer, short_block(Placement(0.02, .165, 0.02)), 3, 3, .0055, 3, 5);
    return writer;
}

} // namespace hemilux
