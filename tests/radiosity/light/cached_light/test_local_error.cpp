// What 95 of 100 places are within.
#include "radiosity/light/cached_light/local_error.h"
#include "support/catch.h"

#include <cmath>

using namespace hemilux;

TEST_CASE("95 of 100 places are within the local error, by weight") {
    LocalErrors errors;
    for (int k = 1; k <= 100; ++k)
        errors.add(1e-4 * k * k, 1);
    CHECK(errors.within() == Approx(.95));
    errors.add(25, 1, 4); // still fewer than 5 of 104
    CHECK(errors.within() == Approx(.99));
    errors.add(25, 1, 4);
    CHECK(errors.within() == Approx(5));
}

TEST_CASE("a local error is relative to the light at its place") {
    LocalErrors errors;
    for (int k = 0; k < 90; ++k)
        errors.add(1, 1e4); // a bright room
    CHECK(errors.within() == Approx(.01));
    for (int k = 0; k < 10; ++k)
        errors.add(1e-4, 1e-4); // a dark one
    CHECK(errors.within() == Approx(1));
}

TEST_CASE("a place that is off and shows no light is infinitely far off; chance is no error") {
    LocalErrors errors;
    CHECK(std::isnan(errors.within()));
    errors.add(0, 0); // right: neither light nor error
    CHECK(std::isnan(errors.within()));
    errors.add(-1, 1); // a product of two estimates
    CHECK(errors.within() == 0);
    errors.add(1, 0);
    CHECK(std::isinf(errors.within()));
}
