// What `hemilux density` writes and says.
#include "app/check_fails.h"
#include "support/catch.h"

using Catch::Contains;
using test::Workplace;

TEST_CASE("density draws a hemisphere and a picture") {
    const Workplace place;
    place.write_room();
    const auto outcome =
        place.hemilux("density room.obj --max-edge .3 --rays 200 --size 80x60 -o h.svg -o d.png");
    REQUIRE(outcome.code == 0);
    CHECK(outcome.out.empty());
    CHECK_THAT(outcome.err, Contains("largest spread") && Contains("96 patches") &&
                                Contains("density rays") && Contains("wrote h.svg") &&
                                Contains("wrote d.png"));
    const std::string svg = place.read("h.svg");
    CHECK(svg.rfind("<svg ", 0) == 0);
    CHECK(svg.ends_with("</svg>\n"));
    CHECK_THAT(svg, Contains("64 triangles") && Contains("from the side") &&
                        Contains(" energy rays") && Contains("surfaces per ray"));
    CHECK(place.read("d.png").substr(1, 3) == "PNG");
}

TEST_CASE("density draws the patch that was asked for") {
    const Workplace place;
    place.write_room();
    const auto outcome = place.hemilux("density room.obj --patch 5 --depth 1 -o h.svg");
    CHECK(outcome.code == 0);
    CHECK_THAT(outcome.err, !Contains("largest spread"));
    CHECK_THAT(place.read("h.svg"), Contains("patch 5 (") && Contains("16 triangles"));
    CHECK(place.hemilux("density room.obj --patch 5 --threshold 100 -q -o u.svg").err.empty());
    CHECK_THAT(place.read("u.svg"), Contains("4 triangles"));
    CHECK(place.hemilux("density room.obj --patch 47 --two-sided -o b.svg").code == 0);
    CHECK_THAT(place.read("b.svg"), Contains("patch 47 ("));
}

TEST_CASE("density draws the hemispheres over the parts of a patch") {
    const Workplace place;
    place.write_room();
    const std::string density = "density room.obj --method hemisphere-1997 ";
    CHECK(place
              .hemilux(density + "--patch 5 --estimated-steps 0 --rays 90 -o h.svg -o d.png "
                                 "--size 40x30")
              .code == 0);
    CHECK_THAT(place.read("h.svg"), Contains("part 0, 64 triangles") &&
                                        Contains("over each part of the patch") &&
                                        Contains(" energy rays"));
    CHECK(place
              .hemilux(density + "--patch 5 --stored-steps 0 --estimated-steps 1 --parts 1 -o "
                                 "one.svg")
              .code == 0);
    CHECK_THAT(place.read("one.svg"), Contains("16 triangles") && Contains("from the side"));
    CHECK(place.hemilux(density + "--patch 5 --part 3 --parts 4 -q -o p.svg").err.empty());
    CHECK_THAT(place.read("p.svg"), Contains("part 3, 256 triangles"));
}

TEST_CASE("density draws the subdivision in a plane") {
    const Workplace place;
    place.write_room();
    for (const std::string method : {"hemisphere", "hemisphere-1997"}) {
        CHECK(place.hemilux("density room.obj --plane --patch 5 --method " + method + " -o p.svg")
                  .code == 0);
        CHECK_THAT(place.read("p.svg"), Contains("patch 5 (") && Contains("P3P1 / P2P3"));
    }
}

TEST_CASE("density gives the same bytes for the same seed, whatever the threads") {
    const Workplace place;
    place.write_room();
    CHECK(place.hemilux("density room.obj --rays 50 -t 1 -o a.svg").code == 0);
    CHECK(place.hemilux("density room.obj --rays 50 -t 3 -o b.svg").code == 0);
    CHECK(place.hemilux("density room.obj --rays 50 --seed 2 -o c.svg").code == 0);
    CHECK(place.read("a.svg") == place.read("b.svg"));
    CHECK(place.read("a.svg") != place.read("c.svg"));
}

TEST_CASE("density needs no light") {
    const Workplace place;
    place.write("dark.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    CHECK(place.hemilux("density dark.obj -o a.svg -o a.png --size 40x30").code == 0);
}

TEST_CASE("density says what is wrong with what it is asked") {
    const Workplace place;
    place.write_room();
    const auto fails = [&](int code, const std::string& arguments, const std::string& message) {
        test::check_fails(place, code, "density " + arguments, message);
    };
    fails(1, "room.obj", "--output");
    fails(1, "room.obj -o a.csv", ".svg or .png");
    fails(1, "room.obj -o a.svg --patch 24", "numbered from 0 to 23");
    fails(1, "room.obj -o a.svg --patch -1", "--patch");
    fails(1, "room.obj -o a.png --patch 2", "there is none");
    fails(1, "room.obj -o a.svg --depth 6", "--depth");
    fails(1, "room.obj -o a.svg --method matrix", "unknown method");
    fails(1, "room.obj -o a.svg --parts 4 --part 1", "numbered from 0 to 0");
    fails(1, "room.obj -o a.svg --parts 16", "--parts 16 is for --method hemisphere-1997");
    fails(1, "room.obj -o a.svg --method hemisphere-1997 --part 4", "numbered from 0 to 3");
    fails(1, "room.obj -o a.png --plane", "there is none");
    fails(1, "room.obj -o a.svg -o a.svg", "named twice");
    fails(2, "none.obj -o a.svg", "none.obj");
    fails(3, "room.obj -o nowhere/a.svg", "nowhere");
    CHECK_FALSE(place.has("a.svg"));
}
