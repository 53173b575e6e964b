#include "io/files/atomic_file.h"
#include "io/files/error.h"
#include "io/results/csv.h"
#include "io/results/tables.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"

#include <cmath>
#include <limits>

using namespace hemilux;
using namespace hemilux::test;

namespace {

/// A room far from the origin, of a size that is no power of two.
Mesh far_room(bool two_sided = false) {
    Scene scene =
        box_room({1e5, 0, 0}, {1e5 + 3, 5, 7}, 2,
                 {{"white, \"matt\"", {0.1, 0.2, 0.3}, Vec3(0)}, {"lamp", Vec3(0.5), {1, 2, 3}}},
                 {0, 1, 0, 0, 0, 0});
    scene.groups = {"detail one"};
    return Mesh(std::move(scene), {.two_sided = two_sided});
}

std::vector<Vec3> random_values(std::size_t count, std::uint64_t seed) {
    Rng rng(seed);
    std::vector<Vec3> values(count);
    for (Vec3& v : values)
        v = {rng.uniform(), 1e-12 * rng.uniform(), 1e12 * rng.uniform()};
    return values;
}

std::vector<std::vector<std::string>> records_of(const std::string& path) {
    const std::string text = content_of(path);
    csv::Reader reader(path, text);
    std::vector<std::vector<std::string>> records;
    std::vector<std::string> fields;
    while (reader.next(fields))
        records.push_back(fields);
    return records;
}

/// A table with one good row and then `row`.
std::string small_table(const std::string& row) {
    return "patch,area,x,y,z,radiosity_r,radiosity_g,radiosity_b,stderr_r,stderr_g,stderr_b\n"
           "0,1,0,0,0,1,1,1,0,0,nan\n" +
           row + "\n";
}

} // namespace

TEST_CASE("the patch table has the columns of the contract") {
    const TemporaryFolder folder;
    const Mesh mesh = far_room();
    const std::vector<Vec3> b(mesh.patches().size(), {0.25, 0.5, 1});
    write_patch_table(folder.path("a.csv"), mesh, b, {});
    const std::string text = content_of(folder.path("a.csv"));
    CHECK(text.substr(0, text.find('\n')) ==
          "patch,face,material,group,area,x,y,z,nx,ny,nz,reflectance_r,reflectance_g,reflectance_b,"
          "emission_r,emission_g,emission_b,radiosity_r,radiosity_g,radiosity_b,stderr_r,stderr_g,"
          "stderr_b");
    const auto records = records_of(folder.path("a.csv"));
    REQUIRE(records.size() == 1 + 24);
    const std::vector<std::string> floor{"0",          "0",    "white, \"matt\"",
                                         "detail one", "5.25", "100000.75",
                                         "0",          "1.75", "0",
                                         "1",          "0",    "0.1",
                                         "0.2",        "0.3",  "0",
                                         "0",          "0",    "0.25",
                                         "0.5",        "1",    "0",
                                         "0",          "0"};
    CHECK(records[1].size() == floor.size());
    for (const std::size_t i : {0u, 1u, 2u, 3u, 5u, 11u, 12u, 13u, 14u, 17u, 18u, 19u, 20u})
        CHECK(records[1][i] == floor[i]);
    for (const std::size_t i : {4u, 5u, 6u, 7u, 8u, 9u, 10u})
        CHECK(std::stod(records[1][i]) == Approx(std::stod(floor[i])).margin(1e-9));
    CHECK(records[5][2] == "lamp");
    CHECK(records[5][16] == "3");
}

TEST_CASE("what a patch table says is read back to the last bit") {
    const TemporaryFolder folder;
    const Mesh mesh = far_room();
    const std::size_t n = mesh.patches().size();
    const std::vector<Vec3> b = random_values(n, 1), e = random_values(n, 2);
    write_patch_table(folder.path("a.csv"), mesh, b, e);
    const PatchTable table = read_patch_table(folder.path("a.csv"));
    CHECK(table.radiosity == b);
    CHECK(table.standard_error == e);
    REQUIRE(table.area.size() == n);
    double area = 0;
    for (std::size_t i = 0; i < n; ++i) {
        area += table.area[i];
        CHECK(table.centre[i] == mesh.frame().to_world(mesh.patches()[i].centre));
    }
    CHECK(area == Approx(2 * (3 * 5 + 5 * 7 + 3 * 7)));
}

TEST_CASE("a long patch table has the same bytes for any number of threads") {
    const TemporaryFolder folder;
    const Mesh mesh(
        box_room(Vec3(0), {2, 3, 5}, 60, {{"white", Vec3(0.5), Vec3(0)}}, {0, 0, 0, 0, 0, 0}));
    const std::size_t n = mesh.patches().size();
    REQUIRE(n == 6 * 60 * 60);
    const std::vector<Vec3> b = random_values(n, 3), e = random_values(n, 4);
    write_patch_table(folder.path("one.csv"), mesh, b, e);
    write_patch_table(folder.path("three.csv"), mesh, b, e, Workers(3));
    CHECK(content_of(folder.path("three.csv")) == content_of(folder.path("one.csv")));
    CHECK(read_patch_table(folder.path("three.csv")).radiosity == b);
}

TEST_CASE("unknown standard errors survive the table") {
    const TemporaryFolder folder;
    const Mesh mesh = far_room();
    const std::vector<Vec3> b(mesh.patches().size(), Vec3(1));
    const std::vector<Vec3> e(mesh.patches().size(), Vec3(-std::nan("")));
    write_patch_table(folder.path("a.csv"), mesh, b, e);
    CHECK(content_of(folder.path("a.csv")).find("-nan") == std::string::npos);
    CHECK(std::isnan(read_patch_table(folder.path("a.csv")).standard_error[3].y));
}

TEST_CASE("a two-sided sheet gives two rows, front first") {
    const TemporaryFolder folder;
    const Mesh mesh = far_room(true);
    const std::vector<Vec3> b(mesh.patches().size(), Vec3(1));
    write_patch_table(folder.path("a.csv"), mesh, b, {});
    const auto records = records_of(folder.path("a.csv"));
    REQUIRE(records.size() == 1 + 48);
    for (std::size_t i = 1; i < records.size(); i += 2) {
        CHECK(records[i][1] == records[i + 1][1]);
        for (std::size_t axis = 8; axis < 11; ++axis)
            CHECK(std::stod(records[i][axis]) == -std::stod(records[i + 1][axis]));
    }
    CHECK(records[1][9] == "1"); // the floor's front looks up
}

TEST_CASE("a table may have other columns, another order and other line ends") {
    const TemporaryFolder folder;
    write_atomically(folder.path("a.csv"),
                     "\xEF\xBB\xBFstderr_r,stderr_g,stderr_b,note,radiosity_b,radiosity_g,"
                     "radiosity_r,z,y,x,area,patch\r\n"
                     "9,10,11,\"a, \"\"b\"\"\r\nc\",8,7,6,5,4,3,2,0");
    const PatchTable table = read_patch_table(folder.path("a.csv"));
    REQUIRE(table.area.size() == 1);
    CHECK(table.area[0] == 2);
    CHECK(table.centre[0] == Vec3(3, 4, 5));
    CHECK(table.radiosity[0] == Vec3(6, 7, 8));
    CHECK(table.standard_error[0] == Vec3(9, 10, 11));
}

TEST_CASE("a bad patch table is refused with its line") {
    struct Case {
        std::string text, message;
    };
    const auto bad = GENERATE(values<Case>({
        {"", "is empty"},
        {"patch,area\n0,1\n", ":1: expected the header of a patch table with a column 'x'"},
        {small_table("1,1,0,0,0,1,1,1,0,0"), ":3: expected 11 fields, got 10"},
        {small_table("1,1,0,0,0,1,1,1,0,0,0,0"), ":3: expected 11 fields, got 12"},
        {small_table("1,1,0,0,0,1,1,bright,0,0,0"), "'radiosity_b', got 'bright'"},
        {small_table("1,1,0,0,0,1,,1,0,0,0"), ":3: expected a number in column 'radiosity_g'"},
        {small_table("1,1,0,0,0,1,1 ,1,0,0,0"), ":3: expected a number"},
        {small_table("1,1,0,0,0,inf,1,1,0,0,0"), ":3: expected a finite number"},
        {small_table("1,0,0,0,0,1,1,1,0,0,0"), ":3: expected a positive area"},
        {small_table("2,1,0,0,0,1,1,1,0,0,0"), ":3: expected patch 1"},
        {small_table("1,1,0,0,0,1,1,1,0,0,\"0"), ":3: a quoted field has no closing quote"},
        {small_table("1,1,0,0,0,1,1,1,0,0,\"0\"0"), ":3: expected a comma"},
    }));
    const TemporaryFolder folder;
    write_atomically(folder.path("bad.csv"), bad.text);
    CHECK_THROWS_AS(read_patch_table(folder.path("bad.csv")), InputError);
    CHECK_THROWS_WITH(read_patch_table(folder.path("bad.csv")), Catch::Contains(bad.message));
}

TEST_CASE("a table that is not there is an input error") {
    const TemporaryFolder folder;
    CHECK_THROWS_AS(read_patch_table(folder.path("none.csv")), InputError);
    CHECK_THROWS_AS(read_patch_table(folder.path("")), InputError); // a folder
}

TEST_CASE("the steps log leaves empty what is not known") {
    const TemporaryFolder folder;
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    const std::vector<StepRow> rows{
        {"hemisphere", 1, {1, 64000, 0.5, unknown}, std::nullopt, std::nullopt},
        {"hemisphere", 1, {2, 128000, 1.5, 0.25}, RelativeError{0.125, unknown, 0.0625}, 0.5}};
    write_steps_log(folder.path("log.csv"), rows);
    CHECK(content_of(folder.path("log.csv")) ==
          "method,run,step,rays,seconds,estimated_error,true_error,true_error_detail,"
          "true_error_rest,total_error\n"
          "hemisphere,1,1,64000,0.5,,,,,\n"
          "hemisphere,1,2,128000,1.5,0.25,0.125,,0.0625,0.5\n");
}
