// Frames are orthonormal for every normal; the named numerical helpers do what they say.

#include "geometry/box.h"
#include "geometry/frame.h"
#include "geometry/numeric.h"
#include "support/catch.h"
#include "support/directions.h"

#include <limits>

using namespace hemilux;
using namespace hemilux::test;

namespace {

void require_orthonormal(const Frame& f) {
    REQUIRE(std::abs(glm::length(f.x) - 1) < 1e-14);
    REQUIRE(std::abs(glm::length(f.y) - 1) < 1e-14);
    REQUIRE(std::abs(glm::dot(f.x, f.y)) < 1e-14);
    REQUIRE(glm::length(glm::cross(f.x, f.y) - f.z) < 1e-14);
}

} // namespace

TEST_CASE("frames of all normals are right-handed and orthonormal") {
    Rng rng(41);
    std::vector<Vec3> normals{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}, {0, 1, -0.0}};
    normals.push_back(glm::normalize(Vec3(1e-9, -1e-9, -1)));
    for (int i = 0; i < 1000; ++i)
        normals.push_back(random_direction(rng));
    for (const Vec3& n : normals) {
        const Frame frame = Frame::from_normal(n);
        require_orthonormal(frame);
        REQUIRE(frame.z == n);
        const Frame turned = frame.turned(.7);
        require_orthonormal(turned);
        REQUIRE(glm::dot(turned.x, frame.x) == Approx(std::cos(.7)));
        REQUIRE(glm::dot(turned.x, frame.y) == Approx(std::sin(.7)));
        const Vec3 v = random_point(rng);
        REQUIRE(glm::length(frame.to_local(frame.to_world(v)) - v) < 1e-14);
    }
}

TEST_CASE("numerical helpers") {
    CHECK(safe_sqrt(-1e-17) == 0);
    CHECK(std::isnan(safe_sqrt(std::numeric_limits<double>::quiet_NaN())));
    // (1 + e)(1 - e) - 1 = -e^2 is lost without the fused error term.
    const double e = 0x1p-30;
    CHECK(difference_of_products(1 + e, 1 - e, 1, 1) == -e * e);
}

TEST_CASE("a box is empty until something is included") {
    Box box;
    CHECK(box.empty());
    CHECK(box.half_area() == 0);
    box.include(Vec3(1, 2, 3));
    box.include(Vec3(0, 4, 2));
    CHECK_FALSE(box.empty());
    CHECK(box.extent() == Vec3(1, 2, 1));
    CHECK(box.centre() == Vec3(.5, 3, 2.5));
    CHECK(box.half_area() == 2 + 2 + 1);
}
