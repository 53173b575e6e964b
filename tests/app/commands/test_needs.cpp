// What a scene does not need: shown by info, left out by solve, recorded, and kept with --keep-all.
#include "app/program.h"
#include "support/catch.h"

using Catch::Contains;
using test::Workplace;

TEST_CASE("info shows what a scene does not need") {
    const Workplace place;
    place.write_room();
    const std::string colours = place.hemilux("info room.obj").out;
    CHECK_THAT(colours, Contains("not needed") && Contains("convex enclosure"));
    CHECK_THAT(colours, !Contains("grey"));
    CHECK_THAT(place.hemilux("info room.obj --reflectance '*=.5' --emission lamp=3").out,
               Contains("two of three colour channels"));
    CHECK_THAT(place.hemilux("info room.obj --reflectance '*=0'").out,
               Contains("nothing reflects"));
    CHECK_THAT(place.hemilux("info room.obj --two-sided").out, Contains("no light can reach"));
    // Without light there is still something to say.
    CHECK_THAT(place.hemilux("info room.obj --emission '*=0'").out,
               Contains("24 patches: no light can reach them"));
}

TEST_CASE("solve records what it left out, and --keep-all leaves out nothing") {
    const Workplace place;
    place.write_room();
    for (const std::string method : {"hemisphere", "matrix", "stratified"}) {
        CAPTURE(method);
        const std::string solve = "solve room.obj --two-sided --rays 16 --steps 2 -q --method ";
        REQUIRE(place.hemilux(solve + method + " -o a.csv --stats a.json").code == 0);
        REQUIRE(place.hemilux(solve + method + " --keep-all -o b.csv --stats b.json").code == 0);
        CHECK(place.read("a.csv") == place.read("b.csv"));
        CHECK_THAT(place.read("b.json"), Contains("\"left_out\": []"));
        const std::string left_out = place.read("a.json");
        if (method == "hemisphere")
            CHECK_THAT(left_out, Contains("\"what\": \"densities\"") &&
                                     Contains("\"why\": \"in a convex enclosure all are 1\"") &&
                                     Contains("\"rays_density\": 0,"));
        if (method == "matrix")
            CHECK_THAT(left_out, Contains("\"what\": \"tests of visibility\"") &&
                                     Contains("no light can reach them"));
        if (method == "stratified")
            CHECK_THAT(left_out, Contains("\"left_out\": []"));
    }
}

TEST_CASE("compare leaves out the same, with the same errors as --keep-all") {
    const Workplace place;
    place.write_room();
    const std::string compare =
        "compare room.obj --runs 1 --budget-rays 5000 --rays 16 "
        "--reference-error .3 --size 40x30 --methods stratified,hemisphere -q -o ";
    const auto with = place.hemilux(compare + "with"),
               all = place.hemilux(compare + "all --keep-all");
    CHECK(with.code == 0);
    CHECK(all.code == 0);
    CHECK(place.read("with/reference.csv") == place.read("all/reference.csv"));
}
