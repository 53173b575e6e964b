// Faces that look away: a room as Blender writes it is lit by the default command, and where the
// file is trusted the program names the option that lights it.
#include "app/program.h"
#include "io/results/tables.h"
#include "io/scene_files/obj.h"
#include "radiosity/light/sides/orientation.h"
#include "support/catch.h"

#include <cstdlib>
#include <filesystem>
#include <regex>

using Catch::Contains;
using hemilux::PatchTable;
using test::Workplace;

namespace {

/// room.obj and room.mtl by scripts/blender_room.sh.
void write_blender_room(const Workplace& place, const std::string& facing) {
    const std::string command = "cd '" + place.path("").string() +
                                "' && sh '" HEMILUX_SOURCE_DIR "/scripts/blender_room.sh' " +
                                facing;
    REQUIRE(std::system(command.c_str()) == 0);
}

double mean_radiosity(const Workplace& place, const std::string& name) {
    const PatchTable table = hemilux::read_patch_table(place.path(name).string());
    double sum = 0, area = 0;
    for (std::size_t i = 0; i < table.area.size(); ++i) {
        sum += table.area[i] * (table.radiosity[i].r + table.radiosity[i].g + table.radiosity[i].b);
        area += table.area[i];
    }
    return sum / area;
}

} // namespace

TEST_CASE("A room from Blender is lit, whichever of its faces look away") {
    const Workplace place;
    const std::string solve = "solve room.obj --max-edge .6 --error .01 -o room.csv";
    write_blender_room(place, "right");
    const auto right = place.hemilux(solve);
    CHECK(right.code == 0);
    CHECK_THAT(right.err, !Contains("turned") && !Contains("warning") && !Contains("note"));
    const double expected = mean_radiosity(place, "room.csv");
    REQUIRE(expected > 0.5);
    for (const char* facing : {"modelled", "reversed", "half 1", "half 2", "half 3", "half 4"}) {
        CAPTURE(facing);
        write_blender_room(place, facing);
        const auto outcome = place.hemilux(solve);
        CHECK(outcome.code == 0);
        CHECK_THAT(outcome.err, Contains("turned ") && Contains("--sides front"));
        CHECK(mean_radiosity(place, "room.csv") == Approx(expected).epsilon(.02));
    }
}

TEST_CASE("--sides front trusts the file, warns and names the option that lights the room") {
    const Workplace place;
    const std::string solve = "solve room.obj --max-edge .6 --error .01 -o room.csv ";
    write_blender_room(place, "right");
    REQUIRE(place.hemilux(solve).code == 0);
    const double expected = mean_radiosity(place, "room.csv");
    for (const char* facing : {"modelled", "reversed", "half 1", "half 2"}) {
        CAPTURE(facing);
        write_blender_room(place, facing);
        const auto dark = place.hemilux(solve + "--sides front");
        CHECK(dark.code == 0);
        CAPTURE(dark.err);
        std::smatch suggested;
        REQUIRE(std::regex_search(dark.err, suggested, std::regex("; (--[a-z]+ [a-z]+) turns")));
        CHECK(place.hemilux(solve + suggested.str(1)).code == 0);
        CHECK(mean_radiosity(place, "room.csv") == Approx(expected).epsilon(.02));
    }
    write_blender_room(place, "modelled");
    const auto dark = place.hemilux("solve room.obj --sides front --steps 2 -o room.csv");
    CHECK_THAT(dark.err, Contains("warning: 7 of 67 faces") && Contains("Cube, Plane") &&
                             Contains("1 closed surface inside out") &&
                             Contains("1 lamp facing a wall at once"));
    CHECK_THAT(dark.err, Contains("nothing is lit") && Contains("100 % of the emitted light"));
    CHECK(place.hemilux("solve room.obj --sides front --steps 1 -q -o room.csv").err.empty());
}

TEST_CASE("Faces in doubt stay, and --sides both is named") {
    const Workplace place;
    write_blender_room(place, "right");
    // A sheet below the lamp that faces down.
    std::string text = place.read("room.obj");
    text += "o Sheet\nv -.4 .9 -.4\nv .4 .9 -.4\nv .4 .9 .4\nv -.4 .9 .4\nusemtl Clay\n"
            "f -4 -3 -2 -1\n";
    place.write("room.obj", text);
    const std::string solve = "solve room.obj --steps 1 --rays 4 -o ";
    const auto trusted = place.hemilux(solve + "front.csv --sides front");
    CHECK(place.hemilux(solve + "auto.csv").err.find("turned") == std::string::npos);
    CHECK(place.read("auto.csv") == place.read("front.csv"));
    for (const auto& words : {trusted.err, place.hemilux("info room.obj").out})
        CHECK_THAT(words, Contains("1 face (group Sheet)"));
    CHECK_THAT(trusted.err, Contains("--sides both lets both sides emit and reflect"));
}

TEST_CASE("info counts what looks away, by kind") {
    const Workplace place;
    write_blender_room(place, "modelled");
    const std::string modelled = place.hemilux("info room.obj").out;
    CHECK_THAT(modelled, Contains("looking away        7 of 67 faces (groups Cube, Plane)") &&
                             Contains("inside out          1 ") &&
                             Contains("lamps turned away   1 ") &&
                             Contains("100 % of what is emitted falls on backs"));
    CHECK_THAT(place.hemilux("info room.obj --sides front").out,
               Contains("--sides auto turns them"));
    write_blender_room(place, "half");
    CHECK_THAT(place.hemilux("info room.obj").out,
               Contains("faces disagree      2 ") && Contains("clashing edges"));
    write_blender_room(place, "right");
    CHECK_THAT(place.hemilux("info room.obj").out,
               !Contains("looking away") && !Contains("clashing") && Contains("light lost"));
}

TEST_CASE("--sides both is --two-sided, and says what the lamps then emit") {
    const Workplace place;
    write_blender_room(place, "right");
    const std::string solve = "solve room.obj --steps 2 --rays 16 ";
    const auto both = place.hemilux(solve + "--sides both -o a.csv");
    CHECK_THAT(both.err,
               Contains("lamps shine to both sides: 19.44 W, where one side emits 9.72 W"));
    CHECK_THAT(place.hemilux("info room.obj --sides both").out, Contains("19.44 W"));
    CHECK(place.hemilux(solve + "--two-sided -o b.csv").code == 0);
    CHECK(place.read("a.csv") == place.read("b.csv"));
    CHECK(place.hemilux(solve + "--two-sided --sides front -o b.csv").code == 1);
    CHECK_THAT(place.hemilux(solve + "--sides bath -o b.csv").err, Contains("did you mean 'both'"));
}

TEST_CASE("Light that leaves the scene is said in words") {
    const Workplace place;
    place.write("sky.mtl", "newmtl lamp\nKd 0 0 0\nKe 1 1 1\nnewmtl grey\nKd .5 .5 .5\n");
    place.write("sky.obj", "mtllib sky.mtl\nv 0 1 0\nv 1 1 0\nv 1 1 1\nv 0 1 1\n"
                           "v 9 0 9\nv 9 0 10\nv 10 0 10\nv 10 0 9\n"
                           "usemtl lamp\nf 1 2 3 4\nusemtl grey\nf 5 6 7 8\n");
    const auto outcome = place.hemilux("solve sky.obj --steps 2 -o sky.csv");
    CHECK(outcome.code == 0);
    CHECK_THAT(outcome.err, Contains("hardly anything is lit") &&
                                Contains("100 % escaped, 0.000 % unshot") &&
                                Contains("backs of faces, 100 % escaped") &&
                                Contains("turn the lamp to the scene"));
    CHECK_THAT(place.hemilux("solve sky.obj --steps 2 --reflectance '*=0' -o sky.csv").err,
               Contains("all reflectances are 0"));
    place.write("sky.obj", "mtllib sky.mtl\nv 0 1 0\nv 1 1 0\nv 1 1 1\nv 0 1 1\n"
                           "v 0 0 0\nv 0 0 1\nv 1 0 1\nv 1 0 0\n"
                           "usemtl lamp\nf 1 2 3 4\nusemtl grey\nf 5 6 7 8\n");
    const std::string bright = "solve sky.obj --steps 2 -o sky.csv --reflectance ";
    const std::string dim_err = place.hemilux(bright + "grey=.8").err;
    CHECK_THAT(dim_err, Contains("much light is lost") && !Contains("hardly anything"));
}

namespace {

std::vector<std::string> example_scenes() {
    std::vector<std::string> paths;
    const std::string folder = HEMILUX_SOURCE_DIR "/examples/scenes";
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".obj")
            paths.push_back(entry.path().string());
    return paths;
}

} // namespace

TEST_CASE("No face of the example scenes is turned, and all of them if all are reversed") {
    for (const std::string& path : example_scenes()) {
        CAPTURE(path);
        hemilux::Scene scene = hemilux::read_obj(path).scene;
        CHECK(hemilux::find_orientation(scene).faces == 0);
        hemilux::Orientation all;
        all.looks_away.assign(scene.faces, true);
        hemilux::turn_faces(scene, all);
        CHECK(hemilux::find_orientation(scene).faces == scene.faces);
    }
}

TEST_CASE("--sides auto and front give the same table of a scene that faces the right way") {
    const Workplace place;
    for (const std::string& path : example_scenes()) {
        CAPTURE(path);
        const std::string solve = "solve '" + path + "' --steps 1 --rays 1 --method stratified -o ";
        CHECK_THAT(place.hemilux(solve + "auto.csv").err, !Contains("turned"));
        CHECK(place.hemilux(solve + "front.csv --sides front").code == 0);
        CHECK(place.read("auto.csv") == place.read("front.csv"));
    }
}
