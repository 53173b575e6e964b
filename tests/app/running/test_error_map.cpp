// `hemilux solve --error-map`: where patches are too large.
#include "app/check_fails.h"
#include "support/catch.h"

using Catch::Contains;
using test::Workplace;

TEST_CASE("a picture of errors is written, the same for any number of threads") {
    const Workplace place;
    place.write_room();
    const std::string common =
        "solve room.obj -q --steps 2 --size 64x48 " + test::camera_in_room + "--error-map ";
    REQUIRE(place.hemilux(common + "a.png -t 1").code == 0);
    REQUIRE(place.hemilux(common + "b.png -t 3").code == 0);
    CHECK(place.read("a.png").substr(1, 3) == "PNG");
    CHECK(place.read("a.png") == place.read("b.png"));
    REQUIRE(place.hemilux(common + "c.png --max-edge .1").code == 0);
    CHECK(place.read("a.png") != place.read("c.png"));
}

TEST_CASE("--error-map takes a .png that is no other file of the run") {
    const Workplace place;
    place.write_room();
    for (const auto& [arguments, message] :
         {std::pair("--error-map a.hdr", "--error-map: expected a file name that ends with .png"),
          {"--error-map a", "expected a file name that ends with .png"},
          {"--error-map a.png -o a.png", "are one file"}})
        test::check_fails(place, 1, std::string("solve room.obj ") + arguments, message);
    CHECK(place.hemilux("solve room.obj --error-map none/a.png").code == 3);
}
