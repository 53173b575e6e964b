// --plain: the page of a method instead of its engine.
#include "app/check_fails.h"
#include "support/catch.h"

#include <string>

using Catch::Contains;
using test::Workplace;

TEST_CASE("solve --plain writes the bytes of the engine") {
    const Workplace place;
    place.write_room();
    for (const std::string options :
         {"hemisphere", "hemisphere --literal", "hemisphere --depth 3 --threshold 1",
          "hemisphere --sides both", "hemisphere-1997",
          "hemisphere-1997 --literal --stored-steps 1 --estimated-steps 1 --parts 1", "monte-carlo",
          "progressive-monte-carlo"}) {
        CAPTURE(options);
        const std::string solve = "solve room.obj --rays 16 --steps 3 -q --method " + options;
        REQUIRE(place.hemilux(solve + " -o engine.csv").code == 0);
        REQUIRE(place.hemilux(solve + " --plain -o plain.csv --stats plain.json").code == 0);
        CHECK(place.read("plain.csv") == place.read("engine.csv"));
        CHECK_THAT(place.read("plain.json"), Contains("\"left_out\": []"));
    }
}

TEST_CASE("solve --plain writes all that a run writes, with the true error") {
    const Workplace place;
    place.write_room();
    REQUIRE(place.hemilux("solve room.obj -q --steps 2 -o reference.csv").code == 0);
    const auto outcome = place.hemilux("solve room.obj --plain --steps 2 --size 40x30 "
                                       "--reference reference.csv -o a.png -o a.ply "
                                       "--steps-log steps.csv");
    CHECK(outcome.code == 0);
    CHECK_THAT(outcome.err, Contains("stored-transport") && Contains("true error"));
    CHECK(place.has("a.png"));
    CHECK(place.has("a.ply"));
    CHECK_THAT(place.read("steps.csv"), Contains("stored-transport"));
}

TEST_CASE("solve --plain is refused where there is no page or the page has no such option") {
    const Workplace place;
    place.write_room();
    const auto refused = [&](const std::string& options, const std::string& message) {
        test::check_fails(place, 1, "solve room.obj -o a.csv --plain " + options, message);
        CHECK_FALSE(place.has("a.csv"));
    };
    const std::string pages =
        "has no page; these have one: hemisphere, "
        "hemisphere-1997, matrix, monte-carlo, progressive, progressive-monte-carlo, "
        "stored-transport";
    for (const char* name : {"hierarchical", "stratified"})
        refused("--method " + std::string(name), "--method " + std::string(name) + " " + pages);
    refused("--method monte-carlo --checkpoint a", "leave out --checkpoint and --resume");
    refused("--method hemisphere --resume a", "leave out --checkpoint and --resume");
    refused("--max-edge .01", "up to 2 000 patches");
    refused("--method matrix --exact", "leave out --exact");
    CHECK_THAT(place.hemilux("compare room.obj -o a --plain").err, Contains("--plain"));
}
