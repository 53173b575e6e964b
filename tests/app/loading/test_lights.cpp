// Lights that the command line adds: what they bring is known in closed form.
#include "app/program.h"
#include "app/statistics_file.h"
#include "io/results/tables.h"
#include "support/catch.h"

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

using Catch::Contains;
using hemilux::PatchTable;
using test::Workplace;

namespace {

/// A square of 2 x 2 m that reflects half of the light, its front upwards; nothing emits.
void write_ground(const Workplace& place) {
    place.write("ground.mtl", "newmtl ground\nKd .5 .5 .5\nnewmtl Ceiling_Lamp\nKd .5 .5 .5\n");
    place.write("ground.obj", "mtllib ground.mtl\nv -1 0 -1\nv -1 0 1\nv 1 0 1\nv 1 0 -1\n"
                              "g ground\nusemtl ground\nf 1 2 3 4\n");
}

/// The red radiosity of the ground [W/m2].
double ground_light(const Workplace& place, const std::string& options) {
    const auto run = place.hemilux("solve ground.obj -q -o table.csv --stats s.json " + options);
    CAPTURE(options, run.err);
    REQUIRE(run.code == 0);
    const PatchTable table = hemilux::read_patch_table(place.path("table.csv").string());
    return table.radiosity.front().r;
}

} // namespace

TEST_CASE("A sky lights open ground by its own radiosity") {
    const Workplace place;
    write_ground(place);
    CHECK(ground_light(place, "--sky 3") == Approx(1.5).epsilon(.01));
    CHECK(ground_light(place, "--sky 3 --method matrix") == Approx(1.5).epsilon(.01));
}

TEST_CASE("What suns and skies emit is said apart, with what the scene reflects") {
    const Workplace place;
    write_ground(place);
    CHECK(ground_light(place, "--sky 3") == Approx(1.5).epsilon(.01));
    const std::string statistics = place.read("s.json");
    CHECK(test::statistic(statistics, "reflected") == Approx(4 * 3 * 1.5).epsilon(.01));
    CHECK(test::statistic(statistics, "emitted_far") > 100);
    CHECK_THAT(place.hemilux("solve ground.obj -o a.csv --sky 3").err,
               Contains("energy: surfaces reflect 1") && Contains("W under suns and skies"));
    CHECK_THAT(
        place
            .hemilux("solve ground.obj -o a.csv --light 'disc at 0,2,0 towards 0,-1,0 radius "
                     ".2 watts 6'")
            .err,
        Contains("energy: 18 W emitted, "));
}

TEST_CASE("The camera of a glTF file says which axis is upwards where it is level only so") {
    const Workplace place;
    const auto scene = [](const std::string& rotation) {
        // The triangle (0, 0, 0), (1, 0, 0), (0, 1, 0), which shines.
        return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],)"
               R"("nodes":[{"mesh":0},{"camera":0,"rotation":)" +
               rotation +
               R"(}],"cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":0.1}}],)"
               R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],)"
               R"("materials":[{"emissiveFactor":[1,1,1]}],"accessors":[{"bufferView":0,)"
               R"("componentType":5126,"count":3,"type":"VEC3"}],)"
               R"("bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,)"
               R"("uri":"data:application/octet-stream;base64,)"
               "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}";
    };
    const auto camera_chosen = [&](const std::string& rotation) {
        place.write("s.gltf", scene(rotation));
        return place.hemilux("solve s.gltf --camera auto --divide none --size 8x6 -o a.png").err;
    };
    const std::string blender = "[0.483536,0.2087036,0.3368716,0.7804827]";
    CHECK_THAT(camera_chosen(blender), Contains("40,0,0,1"));
    CHECK_THAT(camera_chosen("[0,0,0,1]"), !Contains("40,0,0,1") && Contains(",40"));
    CHECK_THAT(camera_chosen("[-0.7071068,0,0,0.7071068]"), !Contains("40,0,0,1"));

    // That holds for a mesh without a picture, too, and for the other pictures of the scene.
    place.write("s.gltf", scene(blender));
    const std::string solve = "solve s.gltf --divide none --seed 2 --size 8x6 -o a.glb ";
    REQUIRE(place.hemilux(solve).code == 0);
    const std::string alone = place.read("a.glb");
    CHECK_THAT(place.hemilux(solve + "-o a.png").err, Contains("camera 'camera 0' of the scene"));
    CHECK(alone.substr(alone.find("BIN")) ==
          place.read("a.glb").substr(place.read("a.glb").find("BIN")));
    for (const std::string command : {"solve s.gltf --error-map e.png", "density s.gltf -o e.png"})
        CHECK_THAT(place.hemilux(command + " --size 200x150").err,
                   Contains("camera 'camera 0' of the scene"));
    CHECK_THAT(place.hemilux("density s.gltf -o e.svg").err, !Contains("camera"));
}

TEST_CASE("A sun brings its irradiance times the cosine") {
    const Workplace place;
    write_ground(place);
    CHECK(ground_light(place, "--sun 0,-1,0,800") == Approx(400).epsilon(.01));
    CHECK(ground_light(place, "--sun 3,-4,0,800") == Approx(320).epsilon(.01));
    for (const std::string length : {"1e-320", "1e-170", "1e200", "1e308"})
        CHECK(ground_light(place, "--sun 0,-" + length + ",0,800") == Approx(400).epsilon(.01));
    CHECK(ground_light(place, "--light 'disc at 0,2,0 towards 0,-1e-170,0 radius .2 watts 6'") ==
          Approx(ground_light(place, "--light 'disc at 0,2,0 towards 0,-1,0 radius .2 watts 6'")));
    CHECK(ground_light(place, "--sun 3,-4,0,800 --sky 100") == Approx(370).epsilon(.01));
    CHECK(ground_light(place, "--sun 0,-2,0,800,1,2 --sun 1,-1,0,100") ==
          Approx(400 + 50 / std::sqrt(2)).epsilon(.01));
}

TEST_CASE("A lamp emits its watts, and lights what is below as a disc does") {
    const Workplace place;
    write_ground(place);
    const double light =
        ground_light(place, "--max-edge .05 --light 'disc at 0,2,0 towards 0,-1,0 radius .1 "
                            "watts 60'");
    const std::string statistics = place.read("s.json");
    CHECK_THAT(statistics, Contains("60"));
    CHECK(light > 0);
    // All of a sheet of light lands where the ground is as wide as the lamp and close to it.
    const double below =
        ground_light(place, "--light 'rectangle emission 2 size 200x200 towards 0,-1,0 at 0,1,0'");
    CHECK(below == Approx(1).epsilon(.01));
}

TEST_CASE("A point and a spot bring what their intensity says, and their power is emitted") {
    const Workplace place;
    write_ground(place);
    place.write("at.csv", "x,y,z,nx,ny,nz\n0,0,0,0,1,0\n0.6,0,0,0,1,0\n");
    const auto irradiance_at = [&](const std::string& options) {
        const auto run =
            place.hemilux("solve ground.obj --points at.csv --points-output p.csv --stats s.json "
                          "--light '" +
                          options + "'");
        CAPTURE(options, run.err);
        REQUIRE(run.code == 0);
        CHECK_THAT(run.err, Contains("W emitted"));
        std::istringstream rows(place.read("p.csv"));
        std::vector<double> found;
        std::string row;
        std::getline(rows, row);
        while (std::getline(rows, row)) {
            for (int column = 0; column < 7; ++column)
                row.erase(0, row.find(',') + 1);
            found.push_back(std::stod(row));
        }
        return found;
    };
    const double slant = 2 / std::pow(4 + .36, 1.5); // cos / r^2 at the second point
    const auto point = irradiance_at("point at 0,2,0 intensity 8");
    CHECK(point[0] == Approx(2).epsilon(1e-6));
    CHECK(point[1] == Approx(8 * slant).epsilon(1e-6));
    CHECK(irradiance_at("point watts 100.53096491487338 at 0,2,0")[0] == Approx(2).epsilon(1e-6));
    const auto spot = irradiance_at("spot at 0,2,0 towards 0,-3,0 inner 10 outer 20 intensity 8");
    CHECK(spot[0] == Approx(2).epsilon(1e-6));
    const double pi = std::acos(-1.0), inner = std::cos(pi / 18), outer = std::cos(pi / 9);
    const double share = (2 / std::sqrt(4.36) - outer) / (inner - outer);
    CHECK(spot[1] == Approx(8 * slant * share * share).epsilon(1e-6));
    CHECK(irradiance_at("spot at 0,2,0 towards 0,-3,0 inner 5 outer 15 intensity 8")[1] == 0);
    CHECK_THAT(place.hemilux("info ground.obj --light 'spot at 0,2,0 towards 0,-1,0 watts 9'").out,
               Contains("light 1: a spot") && Contains("27 W in all channels"));
}

TEST_CASE("All methods take lights without extent, and what they cannot light is said") {
    const Workplace place;
    write_ground(place);
    const std::string light = "--light 'point at 0,2,0 intensity 8' --divide none ";
    const double truth = ground_light(place, light);
    for (const std::string method : {"matrix", "progressive", "hemisphere", "monte-carlo"}) {
        CAPTURE(method);
        CHECK(ground_light(place, light + "--method " + method) == Approx(truth).epsilon(.01));
    }
    CHECK(ground_light(place, light + "--plain") == Approx(truth).epsilon(.01));
    const auto behind =
        place.hemilux("solve ground.obj --sides front -o t.csv --light 'point at 0,-2,0 watts 1'");
    CHECK(behind.code == 0);
    CHECK_THAT(behind.err, Contains("nothing is lit"));
}

TEST_CASE("A scene without light names what may be a lamp, and ways to light it") {
    const Workplace place;
    write_ground(place);
    const auto dark = place.hemilux("solve ground.obj -q -o table.csv");
    CHECK(dark.code == 2);
    CHECK_THAT(dark.err, Contains("--sky 1") && Contains("--light") && Contains("ground"));
    place.write("ground.obj", place.read("ground.obj") + "usemtl Ceiling_Lamp\nf 4 3 2 1\n");
    CHECK_THAT(place.hemilux("solve ground.obj -q -o table.csv").err,
               Contains("may be lamps: Ceiling_Lamp"));
}

TEST_CASE("Lights that cannot be understood are refused with the form that can") {
    const Workplace place;
    write_ground(place);
    for (const char* options :
         {"--light 'disc at 0,2,0 towards 0,-1,0 watts 60'",
          "--light 'disc at 0,2,0 towards 0,0,0 radius 1 watts 60'",
          "--light 'disc at 0,2 towards 0,-1,0 radius 1 watts 60'",
          "--light 'disc at 0,2,0 towards 0,-1,0 radius 1 watts 60 emission 3'",
          "--light 'disc at 0,2,0 towards 0,-1,0 radius 1 radius 2 watts 60'",
          "--light 'disc at 0,2,0 towards 0,-1,0 radius -1 watts 60'",
          "--light 'disc at 0,2,0 towards 0,-1,0 radius 1 watts'",
          "--light 'rectangle at 0,2,0 towards 0,-1,0 size 1 watts 60'",
          "--light 'rectangle at 0,2,0 towards 0,-1,0 size 1x0 watts 60'",
          "--light 'lamp at 0,2,0'",
          "--light 'point at 0,2,0'",
          "--light 'point at 0,2,0 watts 1 intensity 1'",
          "--light 'point at 0,2,0 emission 1'",
          "--light 'point at 0,2,0 towards 0,1,0 watts 1'",
          "--light 'disc at 0,2,0 towards 0,-1,0 radius 1 intensity 1'",
          "--light 'spot at 0,2,0 watts 1'",
          "--light 'spot at 0,2,0 towards 0,-1,0 inner 30 outer 20 watts 1'",
          "--light 'spot at 0,2,0 towards 0,-1,0 outer 91 watts 1'",
          "--light 'spot at 0,2,0 towards 0,-1,0 radius 1 watts 1'",
          "--sun 0,0,0,5",
          "--sun 0,-1,0",
          "--sun 0,-1,0,-5",
          "--sky -1",
          "--sky blue"}) {
        CAPTURE(options);
        const auto run = place.hemilux("solve ground.obj -o table.csv " + std::string(options));
        CHECK(run.code == 1);
        CHECK_THAT(run.err, Contains("expected"));
        CHECK_FALSE(place.has("table.csv"));
    }
}

TEST_CASE("Sun and sky are not in the way of the camera, nor of the scene's size") {
    const Workplace place;
    write_ground(place);
    const auto run = place.hemilux("solve ground.obj --sun 1,-2,1,5 --sky 1 -o a.png --size 80x60");
    CHECK(run.code == 0);
    const auto info = place.hemilux("info ground.obj --sky 1");
    CHECK_THAT(info.out, Contains("2 0 2"));
    // Nor are they divided.
    CHECK_THAT(place.hemilux("info ground.obj --sky 1 --sun 0,-1,0,1 --max-edge 1").out,
               Contains("patches             36 (as divided)"));
}
