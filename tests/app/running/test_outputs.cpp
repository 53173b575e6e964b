// Results for other programs: on standard output, as JSON, with where they come from.

#include "app/check_fails.h"
#include "app/picture_file.h"
#include "app/program.h"
#include "app/rendering/view.h"
#include "support/catch.h"

#include <nlohmann/json.hpp>

using namespace test;

namespace {

const std::string run = "solve room.obj --steps 2 --size 40x30 " + test::camera_in_room;

} // namespace

TEST_CASE("a result goes to standard output, and what is said to stderr") {
    const Workplace place;
    place.write_room();
    REQUIRE(place.hemilux(run + "-q -o a.csv -o a.ply -o a.glb -o a.png").code == 0);
    const auto table = place.hemilux(run + "-o -");
    CHECK(table.code == 0);
    CHECK(table.out == place.read("a.csv"));
    CHECK_THAT(table.err, Catch::Contains("estimated error"));
    for (const char* kind : {"ply", "glb", "png"})
        CHECK(place.hemilux(run + "-q -o -." + kind).out == place.read(std::string("a.") + kind));
    CHECK(place.hemilux(run + "-q -o - | cat >c.csv; true").code == 0);
    CHECK(place.read("c.csv") == place.read("a.csv"));
    // A file is not replaced.
    CHECK(place.hemilux(run + "-q -o - >b.csv; true").code == 0);
    CHECK(place.read("b.csv") == place.read("a.csv"));
    CHECK(place.hemilux(run + "-q -o - >>b.csv; true").code == 0);
    CHECK(place.read("b.csv") == place.read("a.csv") + place.read("a.csv"));
    CHECK_FALSE(place.has("-"));
    check_fails(place, 1, run + "-o - -o -.ply", "named twice");
    check_fails(place, 1, run + "-o -.png --every-step", "-o - has no name");
}

TEST_CASE("the same result has the same bytes, with what it depends on") {
    const Workplace place;
    place.write_room();
    REQUIRE(place.hemilux(run + "-t 1 -o a.png -o a.hdr -o a.glb --stats s.json").code == 0);
    REQUIRE(place.hemilux(run + "-o b.png -o b.hdr -o b.glb -q --threads 3").code == 0);
    for (const std::string kind : {".png", ".hdr", ".glb"}) {
        CHECK(place.read("a" + kind) == place.read("b" + kind));
        CHECK_THAT(place.read("a" + kind), Catch::Contains("hemilux solve room.obj --steps 2 " +
                                                           test::camera_in_room + "--size 40x30"));
    }
    REQUIRE(place.hemilux(run + "-o c.png --emission 'lamp=9,8,7' --seed 5").code == 0);
    CHECK_THAT(place.read("c.png"), Catch::Contains("--emission lamp=9,8,7 --seed 5"));
}

TEST_CASE("an error of 1 asks whether 1 % was meant") {
    const Workplace place;
    place.write_room();
    check_fails(place, 1, "solve room.obj -o a.png --error 1", "was 1 % meant? Write 1%");
    check_fails(place, 1, "compare room.obj -o a --reference-error 2", "was 2 % meant?");
    REQUIRE(place.hemilux("solve room.obj -q -o a.csv --divide none --error 3%").code == 0);
    REQUIRE(place.hemilux("solve room.obj -q -o b.csv --divide none --error .03 --time 2m").code ==
            0);
    CHECK(place.read("a.csv") == place.read("b.csv"));
}

TEST_CASE("tones and stops change pictures alone where light is bright", "[slow]") {
    const Workplace place;
    place.write_room();
    const std::string with = run + "-q --exposure ";
    REQUIRE(place.hemilux(with + "1e-3 -o a.png").code == 0);
    REQUIRE(place.hemilux(with + "1e-3 -o f.png --tone srgb").code == 0);
    REQUIRE(place.hemilux(with + "1 -o b.png -o b.hdr").code == 0);
    REQUIRE(place.hemilux(with + "1 -o c.png -o c.hdr --tone srgb").code == 0);
    REQUIRE(place.hemilux(run + "-q -o d.png --exposure 0ev").code == 0);
    REQUIRE(place.hemilux(run + "-q -o e.png --exposure +1ev").code == 0);
    CHECK(picture_of(place, "b.png") != picture_of(place, "c.png"));
    CHECK(picture_of(place, "b.hdr") == picture_of(place, "c.hdr"));
    CHECK(picture_of(place, "a.png") == picture_of(place, "f.png"));
    CHECK(picture_of(place, "d.png") != picture_of(place, "e.png"));
    check_fails(place, 1, run + "-o a.png --tone srbg", "did you mean 'srgb'?");
}

TEST_CASE("info answers other programs in JSON") {
    const Workplace place;
    place.write_room();
    const auto outcome = place.hemilux("info room.obj --json --max-edge .25");
    REQUIRE(outcome.code == 0);
    const auto json = nlohmann::json::parse(outcome.out);
    CHECK(json["faces"] == 24);
    CHECK(json["groups"] == 3);
    CHECK(json["patches"] > 24);
    CHECK(json["emitting_materials"] == nlohmann::json::array({"lamp"}));
    CHECK(json["sides"]["faces_looking_away"] == 0);
    CHECK(json["emitted_power"].size() == 3);
    const auto both = place.hemilux("info room.obj --json --sides both");
    CHECK(nlohmann::json::parse(both.out)["sides"].is_null());
}

TEST_CASE("a camera that is printed has no coordinates that are 0 but for rounding") {
    hemilux::Camera camera;
    camera.eye = {6e-16, 13, 1e-3};
    camera.target = {0, 1, -2e-17};
    CHECK_THAT(hemilux::camera_text(camera), Catch::StartsWith("--camera 0,13,0.001,0,1,0,"));
}

TEST_CASE("the axis that is upwards is chosen, or reported where it is guessed") {
    const Workplace place;
    place.write_room();
    const std::string run = "solve room.obj --steps 1 --no-gather --size 8x6 ";
    CHECK_THAT(place.hemilux(run + "--up z -o a.png").err, Catch::Contains(",0,0,1\n"));
    CHECK_THAT(place.hemilux(run + "--up y -o a.png").err,
               Catch::Contains("pictures are seen by --camera ") && !Catch::Contains(",0,0,1"));
    const std::string seen = run + "-q --camera 0.3,0.4,0.9,0.5,0.5,0.2,60";
    REQUIRE(place.hemilux(seen + " --up z -o up.png").code == 0);
    REQUIRE(place.hemilux(seen + ",0,0,1 -o said.png").code == 0);
    REQUIRE(place.hemilux(seen + ",0,0,1 --up y -o both.png").code == 0);
    REQUIRE(place.hemilux(seen + " -o y.png").code == 0);
    CHECK(picture_of(place, "up.png") == picture_of(place, "said.png"));
    CHECK(picture_of(place, "both.png") == picture_of(place, "said.png"));
    CHECK(picture_of(place, "y.png") != picture_of(place, "said.png"));
    REQUIRE(place.hemilux(run + "-q --up z -o z.glb").code == 0);
    CHECK_THAT(place.read("z.glb"), Catch::Contains("\"rotation\""));
    REQUIRE(place.hemilux(run + "-q --up y -o y.glb").code == 0);
    CHECK_THAT(place.read("y.glb"), !Catch::Contains("\"rotation\""));
    test::check_fails(place, 1, run + "--up x -o a.png", "--up: expected y or z, not 'x'");
}

TEST_CASE("--lightmap writes a picture beside the .glb file, the same for any number of threads",
          "[slow]") {
    const Workplace place;
    place.write_room();
    const std::string with = run + "-q --lightmap 64 ";
    REQUIRE(place.hemilux(with + "-t 1 -o a.glb").code == 0);
    REQUIRE(place.hemilux(with + "-t 3 -o b.glb").code == 0);
    REQUIRE(place.hemilux(run + "-q -o c.glb").code == 0);
    CHECK(place.read("a.glb") == place.read("b.glb"));
    CHECK(place.read("a.lightmap.exr") == place.read("b.lightmap.exr"));
    CHECK_THAT(place.read("a.glb"),
               Catch::Contains("\"TEXCOORD_0\"") && Catch::Contains("\"TEXCOORD_1\""));
    CHECK_THAT(place.read("c.glb"), !Catch::Contains("TEXCOORD"));
    CHECK_FALSE(place.has("c.lightmap.exr"));
    check_fails(place, 1, run + "--lightmap 64 -o a.png", "--lightmap is for .glb files");
    check_fails(place, 1, run + "--lightmap 64 -o -.glb", "has none");
    check_fails(place, 1, run + "--lightmap 64 -o a.glb -o a.lightmap.exr", "are one file");
    check_fails(place, 1, run + "--lightmap 15 -o a.glb", "--lightmap: expected");
    std::filesystem::create_symlink("/dev/full", place.path("full.lightmap.exr"));
    check_fails(place, 3, run + "--lightmap 64 -o full.glb", "wrote full.glb");
    check_fails(place, 3, run + "--lightmap 16 -q -o d.glb",
                "do not fit into a lightmap of 16 x 16");
    CHECK_FALSE(place.has("d.glb"));
}
