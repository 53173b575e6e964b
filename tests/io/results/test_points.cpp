// Files of points at which the light is to be known.
#include "io/files/atomic_file.h"
#include "io/files/error.h"
#include "io/results/points.h"
#include "support/catch.h"
#include "support/temporary_folder.h"

using namespace hemilux;
using test::TemporaryFolder;

namespace {

std::vector<NamedPoint> points_in(const std::string& content) {
    const TemporaryFolder folder;
    write_atomically(folder.path("points.txt"), content);
    return read_points(folder.path("points.txt"));
}

} // namespace

TEST_CASE("points are read with commas or blanks, header and comments") {
    for (const char* content :
         {"1,2,3,0,0,2\n4,5,6,0,-3,0\n", "1 2 3 0 0 2\r\n4\t5  6 0 -3 0",
          "x,y,z,nx,ny,nz\n1, 2, 3, 0, 0, 2 # here\n\n# and\n4,5,6,0,-3,0\n",
          "\xef\xbb\xbf# a list\nx y z dx dy dz\n1 2 3 0 0 2\r4 5 6 0 -3 0"}) {
        CAPTURE(content);
        const std::vector<NamedPoint> points = points_in(content);
        REQUIRE(points.size() == 2);
        CHECK(points[0].position == Vec3(1, 2, 3));
        CHECK(points[0].given_normal == Vec3(0, 0, 2));
        CHECK(points[0].normal == Vec3(0, 0, 1));
        CHECK(points[1].position == Vec3(4, 5, 6));
        CHECK(points[1].normal == Vec3(0, -1, 0));
    }
    CHECK(points_in("\n1 2 3 1e-300 0 0").front().normal == Vec3(1, 0, 0));
    CHECK(points_in("\n1 2 3 1e90 0 0").front().line == 2);
}

TEST_CASE("a row that is no point is refused with its line and what was expected") {
    const auto check = [](const std::string& row, const std::string& message) {
        CAPTURE(row);
        CHECK_THROWS_AS(points_in("# points\n" + row), InputError);
        CHECK_THROWS_WITH(points_in("0 0 0 0 0 1\n" + row),
                          Catch::Contains("points.txt:2: expected") && Catch::Contains(message));
    };
    check("1,2,3,0,0", "found the end of the line");
    check("1,2,3,0,0,1,7", "then found \"7\"");
    check("1,,3,0,0,1", "six numbers");
    check("1,2,3,0,0,nan", "found \"nan\"");
    check("1,2,inf,0,0,1", "found \"inf\"");
    check("1,2,1e400,0,0,1", "finite");
    check("1 2 3 0 zero 1", "found \"zero\"");
    check("1 2 3 0 0 0", "normal");
    check("1 2 3 -0 0 1e-999", "normal");
    check("1;2;3;0;0;1", "six numbers");
    CHECK_THROWS_WITH(points_in("nan,2,3,0,0,1\n1,2,3,0,0,1\n"), // no header
                      Catch::Contains("points.txt:1: expected"));
    for (const char* empty : {"", "\n\n", "# nothing\n", "x,y,z,nx,ny,nz\n"})
        CHECK_THROWS_WITH(points_in(empty), Catch::Contains("there is no point"));
    CHECK_THROWS_AS(points_in(std::string("1 2 3 0 0\0 1", 12)), InputError);
}
