// That an option of a method is declared in the method's file alone: tests/CMakeLists.txt builds
// the program with the strategy of examples/own_strategy, and no other file names --coarser.
#include "app/check_fails.h"
#include "app/program.h"
#include "support/catch.h"

using Catch::Contains;
using test::Workplace;

namespace {

const std::string run = "solve room.obj --method equal-rays --rays 20 --steps 2 ";

} // namespace

TEST_CASE("The option of an added strategy changes what it does, and is explained and checked") {
    const Workplace place;
    place.write_room();
    CHECK_THAT(place.hemilux("solve --help").out, Contains("--coarser"));
    CHECK_THAT(place.hemilux("solve --help equal-rays").out,
               Contains("--coarser 0|1|2") && Contains("its triangles"));
    CHECK_THAT(place.hemilux("--print bash").out, Contains("solve/--coarser) words='0 1 2'"));
    REQUIRE(place.hemilux(run + "-o fine.csv").code == 0);
    REQUIRE(place.hemilux(run + "--coarser 1 -o coarse.csv").code == 0);
    CHECK(place.read("fine.csv") != place.read("coarse.csv"));
    test::check_fails(place, 1, run + "-o a.csv --coarser 3", "expected 0, 1 or 2, not '3'");
    test::check_fails(place, 1, run + "-o a.csv --coarser 1 --depth 0", "more than --depth");
    test::check_fails(place, 1, "solve room.obj -o a.csv --coarser 1",
                      "--coarser 1 is for --method equal-rays");
}

TEST_CASE("The option of an added strategy may come from a file, and is noted in files") {
    const Workplace place;
    place.write_room();
    place.write("run.toml", "coarser = 1\n");
    REQUIRE(place.hemilux(run + "--config run.toml -o file.csv").code == 0);
    REQUIRE(place.hemilux(run + "--coarser 1 -o given.csv --stats given.json").code == 0);
    CHECK(place.read("file.csv") == place.read("given.csv"));
    CHECK_THAT(place.read("given.json"), Contains("coarser"));
    place.write("run.toml", "coarser = 5\n");
    test::check_fails(place, 2, run + "--config run.toml -o a.csv",
                      "run.toml:1: coarser: expected 0, 1 or 2");
}

TEST_CASE("A checkpoint keeps the option of an added strategy") {
    const Workplace place;
    place.write_room();
    REQUIRE(place.hemilux(run + "--coarser 1 -o a.csv --checkpoint saved").code == 0);
    const std::string more = "solve room.obj --method equal-rays --rays 20 --steps 4 ";
    test::check_fails(place, 2, more + "--resume saved -o b.csv", "expected --coarser 0, it has 1");
    REQUIRE(place.hemilux(more + "--coarser 1 --resume saved -o b.csv").code == 0);
    REQUIRE(place.hemilux(more + "--coarser 1 -o whole.csv").code == 0);
    CHECK(place.read("b.csv") == place.read("whole.csv"));
}
