// What `hemilux formfactors` writes and says.
#include "app/check_fails.h"
#include "support/catch.h"

#include <cmath>
#include <sstream>
#include <vector>

using Catch::Contains;
using test::Workplace;

namespace {

/// Row sums of a table i,j,F.
std::vector<double> row_sums(const std::string& table, std::size_t patches) {
    std::vector<double> sums(patches);
    std::istringstream lines(table);
    std::string line;
    std::getline(lines, line);
    CHECK(line == "i,j,F");
    while (std::getline(lines, line)) {
        std::size_t i = 0, j = 0;
        double f = 0;
        char comma = 0;
        std::istringstream(line) >> i >> comma >> j >> comma >> f;
        REQUIRE(i < patches);
        REQUIRE(j < patches);
        CHECK((f > 0 && f <= 1));
        sums[i] += f;
    }
    return sums;
}

} // namespace

TEST_CASE("formfactors writes both forms and reports on them") {
    const Workplace place;
    place.write_room();
    const auto outcome = place.hemilux("formfactors room.obj --rays 1024 -o f.csv -o f.npy");
    REQUIRE(outcome.code == 0);
    CHECK(outcome.out.empty());
    for (const char* text : {"24 patches", "factors above 0, from ",
                             "rows: ", "reciprocity: ", "wrote f.csv", "wrote f.npy"})
        CHECK_THAT(outcome.err, Contains(text));
    CHECK(place.read("f.npy").size() == 128 + 24 * 24 * 8);
    for (const double sum : row_sums(place.read("f.csv"), 24))
        CHECK(sum == Approx(1).epsilon(1e-12));
}

TEST_CASE("formfactors --exact needs no chance in a convex room") {
    const Workplace place;
    place.write_room();
    const auto outcome = place.hemilux("formfactors room.obj --exact --rays 1 -o a.csv");
    REQUIRE(outcome.code == 0);
    CHECK_THAT(outcome.err, Contains("240 pairs by contour integration, 0 by rays"));
    for (const double sum : row_sums(place.read("a.csv"), 24))
        CHECK(sum == Approx(1).epsilon(1e-12));
    CHECK(place.hemilux("formfactors room.obj --exact --rays 2 --seed 9 -q -o b.csv").err.empty());
    CHECK(place.read("a.csv") == place.read("b.csv"));
}

TEST_CASE("formfactors by hemicubes has rows that sum to 1 and is asked for by its pixels") {
    const Workplace place;
    place.write_room();
    const auto outcome = place.hemilux("formfactors room.obj --factors hemicube:20 -o a.csv");
    REQUIRE(outcome.code == 0);
    CHECK_THAT(outcome.err, Contains("24 patches, 28.8 k rays"));
    CHECK_THAT(outcome.err, Contains("the error of hemicube factors is not estimated"));
    for (const double sum : row_sums(place.read("a.csv"), 24))
        CHECK(sum == Approx(1).epsilon(1e-12));
    CHECK(place.hemilux("formfactors room.obj --factors hemicube -q -o b.csv").err.empty());
    CHECK(place.hemilux("formfactors room.obj --factors hemicube:64 --seed 5 -q -o c.csv").code ==
          0);
    CHECK(place.read("b.csv") == place.read("c.csv"));
    CHECK(place.read("a.csv") != place.read("b.csv"));
    CHECK(place.hemilux("formfactors room.obj --factors exact -o d.csv").code == 0);
    CHECK(place.hemilux("formfactors room.obj --exact -o e.csv").code == 0);
    CHECK(place.read("d.csv") == place.read("e.csv"));
}

TEST_CASE("formfactors gives the same bytes whatever the threads") {
    const Workplace place;
    place.write_room();
    for (const char* exact : {"", " --exact", " --factors hemicube:14"}) {
        const std::string command = "formfactors room.obj --rays 64" + std::string(exact);
        CHECK(place.hemilux(command + " -t 1 -o a.npy").code == 0);
        CHECK(place.hemilux(command + " -t 3 -o b.npy").code == 0);
        CHECK(place.read("a.npy") == place.read("b.npy"));
    }
}

TEST_CASE("formfactors says what is wrong with what it is asked") {
    const Workplace place;
    place.write_room();
    const auto fails = [&](int code, const std::string& arguments, const std::string& message) {
        test::check_fails(place, code, "formfactors " + arguments, message);
    };
    fails(1, "room.obj", "--output");
    fails(1, "room.obj -o a.png", ".csv or .npy");
    fails(1, "room.obj -o a.csv --rays 1000", "a power of two");
    fails(1, "room.obj -o a.csv --rays 0", "a power of two");
    fails(1, "room.obj -o a.csv -o ./a.csv", "named twice");
    for (const char* factors : {"hemicube:0", "hemicube:15", "hemicube:5000", "hemicube:many",
                                "hemicube:", "hemicube:-4"})
        fails(1, "room.obj -o a.csv --factors " + std::string(factors),
              "an even N from 2 to 1024, not '" + std::string(factors) + "'");
    for (const char* factors : {"exact:64", "cubes"})
        fails(1, "room.obj -o a.csv --factors " + std::string(factors),
              "rays, exact, hemicube or hemicube:N, not '" + std::string(factors) + "'");
    fails(1, "room.obj -o a.csv --exact --factors hemicube", "--exact");
    fails(1, "room.obj -o a.npy --max-edge .015", "up to 20 000 patches");
    fails(2, "none.obj -o a.csv", "none.obj");
    fails(3, "room.obj -o nowhere/a.csv", "nowhere");
    CHECK_FALSE(place.has("a.csv"));
    CHECK_FALSE(place.has("a.npy"));
}
