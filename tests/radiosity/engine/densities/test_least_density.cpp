// What the least density is for: where a crowd is seen on one side, the other still gets rays.
#include "radiosity/engine/solving/engine_solver.h"
#include "radiosity/engine/solving/method.h"
#include "support/catch.h"
#include "support/guided_rays.h"

using namespace hemilux;

// At a fifth of the rays that the power of a part of the hemisphere is due, each of them carries
// five times the mean; by density alone the open side would have none.
TEST_CASE("No ray carries more than five times the mean, however dense a crowd is") {
    const double share = test::share_away_from_crowd(find_method("hemisphere")->make);
    CHECK(share > test::power_away_from_crowd / 5);
    CHECK(share < test::power_away_from_crowd / 2); // the crowd gets most
}
