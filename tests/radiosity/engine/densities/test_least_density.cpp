// What the least density is for: where a crowd is seen on one side, the other still gets rays.
#include "radiosity/engine/solving/method.h"
#include "support/catch.h"
#include "support/guided_rays.h"

using namespace hemilux;

// Half of the power goes to the open side. At a fifth of the rays that this power is due, each of
// them carries five times the mean; by density alone there would be none.
TEST_CASE("No ray carries more than five times the mean, however dense a crowd is") {
    const double share = test::share_away_from_crowd(find_method("hemisphere")->make);
    CHECK(share > .5 / 5);
    CHECK(share < .25); // the crowd gets most
}
