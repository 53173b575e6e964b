#include "io/pictures/camera_text.h"
#include "support/catch.h"

#include <string>

using namespace hemilux;

TEST_CASE("a camera is read from its numbers") {
    const Camera a = parse_camera("1,2,3,4,5,6").value();
    CHECK(a.eye == Vec3(1, 2, 3));
    CHECK(a.target == Vec3(4, 5, 6));
    CHECK(a.vertical_fov_degrees == 45);
    const Camera b = parse_camera(" -1.5, 2e3 ,0,.25,0,0, 60").value();
    CHECK(b.eye == Vec3(-1.5, 2000, 0));
    CHECK(b.target == Vec3(0.25, 0, 0));
    CHECK(b.vertical_fov_degrees == 60);
    CHECK(b.up == Vec3(0, 1, 0));
    CHECK(parse_camera("1,2,3,4,5,6,60,0,0,1").value().up == Vec3(0, 0, 1));
}

TEST_CASE("a camera that cannot be is refused") {
    for (const char* const bad :
         {"", "1,2,3,4,5", "1,2,3,4,5,6,7,8", "1,2,3,4,5,6,7,8,9", "1,2,3,4,5,6,7,0,0,0",
          "1,2,3,4,5,6,7,0,0,1,1", "1,2,3,4,5,6,", "1,2,x,4,5,6", "1,2,3 4,5,6,7", "1,2,nan,4,5,6",
          "1,2,inf,4,5,6", "1,2,3,1,2,3", "1,2,3,4,5,6,0", "1,2,3,4,5,6,180"}) {
        INFO(bad);
        CHECK_FALSE(parse_camera(bad));
    }
}
