// Where the technique of 1997 divides an edge, and what it estimates there: formula (1) by hand.
#include "radiosity/paper/hemisphere/edge_division.h"
#include "support/catch.h"

#include <cmath>

using namespace hemilux;

TEST_CASE("An edge is divided nearer to the end that counted more") {
    CHECK(division_share(1, 3) == Approx(.75));
    CHECK(division_share(3, 1) == Approx(.25));
    CHECK(division_share(2, 2) == Approx(.5));
    CHECK(division_share(0, 3) == .5); // nothing to weigh by
    CHECK(division_share(3, 0) == .5);
}

TEST_CASE("The estimated point lies on the arc and counts as much as its ends there") {
    const CountedDirection a{Vec3(1, 0, 0), 1}, b{Vec3(0, 0, 1), 3};
    const CountedDirection point = estimated_point(a, b);
    CHECK(point.surfaces == Approx(.25 * 1 + .75 * 3));
    CHECK(glm::length(point.direction) == Approx(1));
    CHECK(glm::dot(point.direction, b.direction) == Approx(std::cos(.25 * 1.5707963267948966)));
    CHECK(point.direction.y == 0);
}
