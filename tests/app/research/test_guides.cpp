// --guide and the targets of shooting methods, which the shelf of research brings.
#include "app/check_fails.h"
#include "support/catch.h"

#include <string>

using Catch::Contains;
using test::check_fails;
using test::Workplace;

TEST_CASE("hemisphere is compared with itself, guided in other ways") {
    const Workplace place;
    place.write_room();
    place.write("room.obj", place.read("room.obj") + // something that hides something
                                "v .2 .2 .2\nv .6 .2 .5\nv .3 .7 .4\nf -3 -2 -1\n");
    const auto outcome =
        place.hemilux("compare room.obj -o a --runs 1 --rays 4 -q --methods "
                      "hemisphere,hemisphere-visible,hemisphere-learned,progressive-monte-carlo "
                      "--reference-error .02 --size 40x30 " +
                      test::camera_in_room);
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    const auto difference = [&place](const std::string& name) {
        CHECK(place.has("a/" + name + "_difference.png"));
        return place.read("a/" + name + "_difference.png");
    };
    const std::string by_density = difference("hemisphere"),
                      visible = difference("hemisphere-visible"),
                      learned = difference("hemisphere-learned");
    CHECK(by_density != visible);
    CHECK(learned != visible);
    for (const char* name : {"hemisphere ", "hemisphere-visible ", "hemisphere-learned "})
        CHECK_THAT(outcome.out, Contains(name));
    check_fails(place, 1, "compare room.obj -o a --methods hemisphere-learned,hemisphere-learned",
                "named twice");
}

TEST_CASE("density draws pyramids") {
    const Workplace place;
    place.write_room();
    CHECK(place
              .hemilux("density room.obj --guide pyramid --patch 5 --rays 50 -o h.svg -o d.png "
                       "--size 40x30")
              .code == 0);
    CHECK_THAT(place.read("h.svg"), Contains("root of patches per mean triangle") &&
                                        Contains(" energy rays") && !Contains("density rays"));
    const auto fails = [&](const std::string& arguments, const std::string& message) {
        check_fails(place, 1, "density room.obj -o a.svg " + arguments, message);
    };
    fails("--guide learned", "unknown choice");
    fails("--guide pyramid --plane", "--guide pyramid has none");
    fails("--guide pyramid --method hemisphere-1997", "--guide pyramid is for --method hemisphere");
}

TEST_CASE("--guide is an option of hemisphere alone, and its page has none") {
    const Workplace place;
    place.write_room();
    const std::string solve = "solve room.obj --steps 1 -o a.csv ";
    const auto implied = place.hemilux(solve + "--guide visible");
    CHECK(implied.code == 0);
    CHECK_THAT(implied.err, Contains("hemisphere: "));
    check_fails(place, 1, solve + "--method stratified --guide visible",
                "--guide visible is for --method hemisphere");
    for (const std::string guide : {"visible", "pyramid", "learned"})
        check_fails(place, 1, solve + "--plain --guide " + guide, "leave out --guide " + guide);
    CHECK_THAT(place.hemilux("solve --help hemisphere").out,
               Contains("--guide density|pyramid|visible|learned"));
}

TEST_CASE("Shooting methods take a target") {
    const Workplace place;
    place.write_room();
    const std::string solve = "solve room.obj --steps 2 -o a.csv --for group:walls --method ";
    CHECK(place.hemilux(solve + "hemisphere").code == 0);
    check_fails(place, 1, solve + "hemisphere --literal", "with --literal each patch");
    check_fails(place, 1, solve + "matrix", "these take a target: hemisphere, ");
}
