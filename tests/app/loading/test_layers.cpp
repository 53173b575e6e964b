// -o picture.exr: the layers are what the patch table has.
#include "app/running.h"
#include "support/catch.h"

#include <string>

using Catch::Contains;
using test::Workplace;

TEST_CASE("Ctrl-C ends the count of densities for pictures and pages") {
    const Workplace place;
    place.write_room();
    test::Running run(place,
                      "solve room.obj --method hemisphere --steps 4000000000 -v -o a.exr --report "
                      "a.html --size 16x12 " +
                          test::camera_in_room,
                      place.path("stderr.txt").c_str());
    REQUIRE(test::wait_for(place, "stderr.txt", "step 2:"));
    run.interrupt();
    CHECK(run.wait() == 130);
    CHECK_THAT(place.read("a.html"), !Contains("\"threshold\""));
    // A slow machine may take longer for the picture than it is given.
    CHECK(place.has("a.exr") !=
          Contains("interrupted; left out a.exr").match(place.read("stderr.txt")));
    if (place.has("a.exr"))
        CHECK_THAT(place.read("a.exr").substr(0, 600),
                   Contains("patch") && !Contains(std::string("\0density", 8)));
}

TEST_CASE("a picture with layers has the light of the .hdr picture and its provenance", "[slow]") {
    const Workplace place;
    place.write_room();
    const std::string arguments =
        "solve room.obj --steps 2 -q --size 40x30 " + test::camera_in_room;
    REQUIRE(place.hemilux(arguments + "-t1 -o a.exr").code == 0);
    const std::string file = place.read("a.exr");
    CHECK((place.hemilux(arguments + "-t3 -o -.exr").out == file));
    for (const char* const channel : {"R", "density", "error.G", "irradiance.B", "patch"})
        CHECK_THAT(file.substr(0, 600), Contains(std::string("\0", 1) + channel + '\0'));
    CHECK_THAT(file.substr(0, 900), Contains("hemilux solve room.obj --steps 2 " +
                                             test::camera_in_room + "--size 40x30"));
    // Pictures of steps have the light alone.
    REQUIRE(place.hemilux(arguments + "-o s.exr --every-step").code == 0);
    CHECK_THAT(place.read("s-0001.exr").substr(0, 100), !Contains("density"));
}
