// Faces that look away: a room as Blender writes it is lit by the default command, and where the
// file is trusted the program names the option that lights it.
#include "app/program.h"
#include "io/obj.h"
#include "io/tables.h"
#include "radiosity/orientation.h"
#include "support/blender_room.h"

#include <catch2/catch.hpp>

#include <filesystem>

using Catch::Contains;
using hemilux::PatchTable;
using hemilux::test::blender_room;
using hemilux::test::Facing;
using test::Workplace;

namespace {

void write_blender_room(const Workplace& place, const std::string& name, Facing facing,
                        std::uint64_t seed = 1) {
    place.write(name, blender_room(facing, seed));
    place.write("room.mtl", hemilux::test::blender_materials());
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
    const std::string solve = "--max-edge .6 --error .01 -o ";
    write_blender_room(place, "right.obj", Facing::right);
    const auto right = place.hemilux("solve right.obj " + solve + "right.csv");
    CHECK(right.code == 0);
    CHECK_THAT(right.err, !Contains("turned") && !Contains("warning"));
    const double expected = mean_radiosity(place, "right.csv");
    REQUIRE(expected > 0.5);

    const auto check = [&](Facing facing, std::uint64_t seed) {
        CAPTURE(int(facing), seed);
        write_blender_room(place, "room.obj", facing, seed);
        const auto outcome = place.hemilux("solve room.obj " + solve + "room.csv");
        CHECK(outcome.code == 0);
        CHECK_THAT(outcome.err, Contains("turned ") && Contains("--sides front"));
        CHECK(mean_radiosity(place, "room.csv") == Approx(expected).epsilon(.02));
    };
    check(Facing::as_modelled, 1);
    check(Facing::all_turned, 1);
    for (const std::uint64_t seed : {1u, 2u, 3u, 4u})
        check(Facing::half_turned, seed);
}

TEST_CASE("--sides front trusts the file, warns and names what mends it") {
    const Workplace place;
    write_blender_room(place, "room.obj", Facing::as_modelled);
    const auto dark = place.hemilux("solve room.obj --sides front --steps 2 -o room.csv");
    CHECK(dark.code == 0);
    CHECK_THAT(dark.err, Contains("warning: 7 of 67 faces") && Contains("Cube, Plane") &&
                             Contains("--sides auto turns these faces") &&
                             Contains("1 closed surface inside out") &&
                             Contains("1 lamp facing a wall at once"));
    CHECK_THAT(dark.err, Contains("nothing is lit") && Contains("100 % of the emitted light"));
    // The way out that the message names.
    const auto lit = place.hemilux("solve room.obj --sides auto --steps 2 -o room.csv");
    CHECK(lit.code == 0);
    CHECK_THAT(lit.err, !Contains("nothing is lit"));
    CHECK(mean_radiosity(place, "room.csv") > 0.5);
    CHECK(place.hemilux("solve room.obj --sides front --steps 1 -q -o room.csv").err.empty());
}

TEST_CASE("info counts what looks away, by kind") {
    const Workplace place;
    write_blender_room(place, "room.obj", Facing::as_modelled);
    const std::string modelled = place.hemilux("info room.obj").out;
    CHECK_THAT(modelled, Contains("looking away        7 of 67 faces (groups Cube, Plane)") &&
                             Contains("inside out          1 ") &&
                             Contains("lamps turned away   1 ") &&
                             Contains("100 % of what is emitted falls on backs"));
    CHECK_THAT(place.hemilux("info room.obj --sides front").out,
               Contains("--sides auto turns them"));
    write_blender_room(place, "room.obj", Facing::half_turned);
    CHECK_THAT(place.hemilux("info room.obj").out,
               Contains("faces disagree      2 ") && Contains("clashing edges"));
    write_blender_room(place, "room.obj", Facing::right);
    CHECK_THAT(place.hemilux("info room.obj").out,
               !Contains("looking away") && !Contains("clashing") && Contains("light lost"));
}

TEST_CASE("--sides both is --two-sided, and says what the lamps then emit") {
    const Workplace place;
    write_blender_room(place, "room.obj", Facing::right);
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
    CHECK_THAT(outcome.err, Contains("hardly anything is lit") && Contains("left the scene") &&
                                Contains("turn the lamp to the scene"));
    CHECK_THAT(place.hemilux("solve sky.obj --steps 2 --reflectance '*=0' -o sky.csv").err,
               Contains("all reflectances are 0"));
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
