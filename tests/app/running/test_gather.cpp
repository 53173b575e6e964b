// Pictures whose light is gathered, and where the seconds of a run went.
#include "app/picture_file.h"
#include "app/program.h"
#include "app/running.h"
#include "app/statistics_file.h"
#include "support/catch.h"

#include <cmath>
#include <sstream>
#include <string>

using Catch::Contains;
using test::picture_of;
using test::Running;
using test::statistic;
using test::wait_for;
using test::Workplace;

TEST_CASE("pictures are gathered, unless --no-gather; those of steps are not") {
    const Workplace place;
    place.write_room();
    const std::string common = "solve room.obj -q --steps 1 --size 64x48 " + test::camera_in_room;
    REQUIRE(place.hemilux(common + "--gather 16 --every-step -o a.png").code == 0);
    REQUIRE(place.hemilux(common + "--gather 16 -t 1 -o b.png -o b.hdr").code == 0);
    REQUIRE(place.hemilux(common + "--gather 17 -o c.png").code == 0);
    REQUIRE(place.hemilux(common + "--no-gather -o d.hdr --every-step -o d.png").code == 0);
    CHECK(picture_of(place, "a.png") == picture_of(place, "b.png"));
    CHECK(picture_of(place, "a.png") != picture_of(place, "c.png"));
    CHECK(picture_of(place, "a.png") != picture_of(place, "d.png"));
    CHECK(picture_of(place, "b.hdr") != picture_of(place, "d.hdr"));
    CHECK(picture_of(place, "a-0001.png") == picture_of(place, "d-0001.png"));
    CHECK(picture_of(place, "d-0001.png") == picture_of(place, "d.png"));
    for (const char* bad : {"--gather 0", "--gather 1025", "--gather x", "--gather -3"}) {
        const auto outcome = place.hemilux(common + "-o e.png " + bad);
        CHECK(outcome.code == 1);
        CHECK_THAT(outcome.err, Contains("--gather: expected a whole number from 1 to 1024"));
    }
}

TEST_CASE("a signal ends a gather, and pictures show what there is", "[slow]") {
    const Workplace place;
    place.write_room();
    Running run(place,
                "solve room.obj --steps 4000000000 -v --gather 1024 --size 800x600 "
                "-o a.png -o a.csv",
                place.path("talk.txt").c_str());
    REQUIRE(wait_for(place, "talk.txt", "step 2:"));
    run.interrupt();
    CHECK(run.wait() == 130);
    CHECK(place.has("a.csv"));
    CHECK(place.has("a.png"));
    CHECK_THAT(place.read("talk.txt"), Contains("show the light of the patches"));
}

TEST_CASE("the seconds of the stages are all of a run", "[slow]") {
    const Workplace place;
    place.write_room();
    place.write("p.txt", ".5 .5 .5 0 1 0\n");
    for (const char* threads : {"1", "3"}) {
        REQUIRE(place
                    .hemilux("solve room.obj --max-edge .1 -q --steps 4 -o a.csv -o a.ply "
                             "--points p.txt --points-output light.csv -o a.json --stats b.json "
                             "-o a.png --size 320x240 -t " +
                             std::string(threads))
                    .code == 0);
        const std::string json = place.read("a.json");
        CHECK(json == place.read("b.json"));
        double sum = 0;
        for (const char* stage : {"read", "bvh", "divide", "density", "solve", "division_error",
                                  "analysis", "learn", "gather", "picture", "write"}) {
            const double found = statistic(json, std::string("seconds_") + stage);
            const double seconds = std::isnan(found) ? 0 : found; // null: not measured
            CHECK(seconds >= 0);
            sum += seconds;
        }
        CHECK(sum == Approx(statistic(json, "seconds_total")).epsilon(.02));
        CHECK(statistic(json, "seconds_gather") > 0);
        CHECK(statistic(json, "seconds_picture") > 0);
    }
}
