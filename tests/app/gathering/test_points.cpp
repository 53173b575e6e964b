// `hemilux solve --points`: the light where the user wants to know it.
#include "app/check_fails.h"
#include "support/catch.h"

#include <fstream>
#include <sstream>
#include <sys/stat.h>
#include <thread>
#include <tuple>
#include <vector>

using Catch::Contains;
using test::Workplace;

namespace {

constexpr const char* solve = "solve room.obj -q --points p.txt --points-output light.csv ";

std::vector<std::vector<std::string>> rows_of(const std::string& text) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
        rows.emplace_back();
        std::istringstream fields(line);
        for (std::string field; std::getline(fields, field, ',');)
            rows.back().push_back(field);
    }
    return rows;
}

} // namespace

TEST_CASE("a table of points has irradiance, and radiosity where a face is", "[slow]") {
    const Workplace place;
    place.write_room();
    REQUIRE(place.hemilux("solve room.obj --divide none -q --error .002 -o patches.csv").code == 0);
    const auto patches = rows_of(place.read("patches.csv"));
    const std::vector<std::string>& floor = patches[1];
    place.write("p.txt", "x,y,z,nx,ny,nz\n" + floor[5] + "," + floor[6] + "," + floor[7] + "," +
                             floor[8] + "," + floor[9] + "," + floor[10] + "\n.5 .5 .5 0 -2 0\n");
    REQUIRE(place.hemilux(solve).code == 0);
    const auto rows = rows_of(place.read("light.csv"));
    REQUIRE(rows.size() == 3);
    CHECK(rows[0] == std::vector<std::string>{"point", "x", "y", "z", "nx", "ny", "nz",
                                              "irradiance_r", "irradiance_g", "irradiance_b",
                                              "radiosity_r", "radiosity_g", "radiosity_b",
                                              "stderr_r", "stderr_g", "stderr_b"});
    CHECK(std::stod(rows[1][10]) ==
          Approx(std::stod(floor[14]) + std::stod(floor[11]) * std::stod(rows[1][7])));
    CHECK(rows[2][5] == "-2"); // as it was given
    CHECK(rows[2][10].empty());
    for (std::size_t row : {1u, 2u}) {
        CHECK(std::stod(rows[row][7]) > 0);
        CHECK(std::stod(rows[row][13]) > 0);
        CHECK(std::stod(rows[row][13]) < .05 * std::stod(rows[row][7]));
    }
}

TEST_CASE("points are the same for any number of threads, and from a pipe to stdout") {
    const Workplace place;
    const std::string coarse = "solve room.obj -q --divide none --error 10% --points ";
    place.write_room();
    place.write("p.txt", ".5 .5 .5 0 1 0\n.2 .3 .4 1 0 0\n");
    REQUIRE(place.hemilux(coarse + "p.txt --points-output light.csv -t 1").code == 0);
    const std::string one = place.read("light.csv");
    REQUIRE(place.hemilux(coarse + "p.txt --points-output light.csv -t 3").code == 0);
    CHECK(place.read("light.csv") == one);
    REQUIRE(mkfifo(place.path("pipe").c_str(), 0600) == 0);
    std::thread writer([&] { std::ofstream(place.path("pipe")) << place.read("p.txt"); });
    const auto shown = place.hemilux(coarse + "pipe --points-output /dev/stdout");
    writer.join();
    CHECK(shown.code == 0);
    CHECK(shown.out == one);
    REQUIRE(place.hemilux(coarse + "p.txt --points-output light.csv --gather 64").code == 0);
    CHECK(place.read("light.csv") != one);
}

TEST_CASE("what --points cannot be is said at once") {
    const Workplace place;
    place.write_room();
    place.write("p.txt", "0 0 0 0 1 0\n1 2 3 0 0 0\n");
    const auto bad = place.hemilux(solve);
    CHECK(bad.code == 2);
    CHECK_THAT(bad.err, Contains("p.txt:2: expected a normal"));
    place.write("p.txt", "\x1f\x8b\x08");
    CHECK_THAT(place.hemilux(solve).err, Contains("p.txt: expected text, the file is compressed"));
    place.write("p.txt", "1e9 0 0 0 1 0\n");
    CHECK_THAT(place.hemilux(solve).err, Contains("p.txt:1: expected a point near the scene"));
    CHECK_FALSE(place.has("light.csv"));
    for (const auto& [arguments, code, message] :
         {std::tuple("--points none.txt --points-output a.csv", 2, "none.txt: cannot read"),
          {"--points /dev/zero --points-output a.csv", 2, "expected a file"},
          {"--points p.txt", 1, "--points-output"},
          {"--points-output a.csv", 1, "add --points"},
          {"--points p.txt --points-output p.txt", 1, "are one file"},
          {"--points p.txt --points-output room.mtl", 1, "are one file"},
          {"--points p.txt --points-output a.csv -o a.csv", 1, "are one file"},
          {"--points p.txt --points-output a.csv -o p.txt.csv --gather 0", 1, "--gather"},
          {"--points p.txt --points-output a/b.csv", 3, "does not exist"}})
        test::check_fails(place, code, std::string("solve room.obj ") + arguments, message);
    REQUIRE(mkfifo(place.path("pipe").c_str(), 0600) == 0);
    const auto twice =
        place.hemilux("solve room.obj --points pipe --reference pipe --points-output a.csv");
    CHECK(twice.code == 1);
    CHECK_THAT(twice.err, Contains("can be read once"));
    CHECK_FALSE(place.has("a.csv"));
}

TEST_CASE("rows of points that --max-rays leaves hold no light, and it is said") {
    const Workplace place;
    place.write_room();
    std::string points;
    for (int i = 0; i < 10'000; ++i)
        points += ".5 .5 .5 0 0 1\n";
    place.write("p.txt", points);
    const auto run = place.hemilux("solve room.obj --divide none --max-rays 400000 --points p.txt "
                                   "--points-output light.csv");
    CHECK(run.code == 0);
    CHECK_THAT(run.err, Contains("--max-rays ended it after"));
    CHECK_THAT(run.err, Contains("hold no light"));
    const std::string table = place.read("light.csv");
    const auto rows = rows_of(table);
    REQUIRE(rows.size() == 10'001);
    CHECK(std::stod(rows[1][7]) > 0);
    CHECK(table.ends_with("\n9999,0.5,0.5,0.5,0,0,1,,,,,,,,,\n"));
}
