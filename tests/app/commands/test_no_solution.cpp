// What the program says of scenes that have no solution, and what it keeps.
#include "app/program.h"
#include "support/catch.h"

using Catch::Contains;
using test::Workplace;

TEST_CASE("a closed scene of reflectance 1 names the faces that enclose a lamp", "[slow]") {
    const Workplace place;
    place.write_room();
    for (const char* command : {"solve room.obj -o a.csv", "compare room.obj -o a"}) {
        const auto outcome = place.hemilux(command + std::string(" --reflectance '*=1'"));
        CHECK(outcome.code == 2);
        CHECK_THAT(outcome.err, Contains("room.obj:") && Contains("no finite solution") &&
                                    Contains("24 patches") && Contains("'lamp'") &&
                                    Contains("walls"));
        CHECK_FALSE(place.has("a.csv"));
    }
    CHECK(place.hemilux("solve room.obj -o a.csv --steps 1 --reflectance white=1").code == 0);
}

TEST_CASE("emissions that overflow are refused with the face's line") {
    const Workplace place;
    place.write_room();
    const auto outcome = place.hemilux("solve room.obj -o a.csv --emission lamp=1e308");
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.err, Contains("room.obj:") && Contains("the emission of patch"));
    CHECK_FALSE(place.has("a.csv"));
}

TEST_CASE("an overflow within a run writes what was computed before") {
    const Workplace place;
    place.write_room();
    const std::string scene = "room.obj --reflectance '*=.5' --emission '*=4.6e144' --rays 200 ";
    const auto outcome =
        place.hemilux("solve " + scene +
                      "--method hemisphere --steps 9999 -o a.csv -o a.json -o a.png --size 9x9");
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.err, Contains("room.obj:") && Contains(": step ") &&
                                Contains("before that") && Contains("wrote a.csv"));
    CHECK_THAT(place.read("a.csv"), Contains("e+144,") && !Contains("inf"));
    CHECK_THAT(place.read("a.json"), Contains("\"imbalance\"") && !Contains("\"steps\": 0"));
    CHECK(place.has("a.png"));
    const auto compared = place.hemilux("compare " + scene +
                                        "-o a --methods hemisphere --budget-rays 1e8 --size 9x9");
    CHECK(compared.code == 2);
    CHECK_THAT(compared.out, Contains("hemisphere  "));
    CHECK(place.has("a/error.csv"));
}
