// The order in which monte-carlo takes the patches.
#include "radiosity/engine/sampling/largest_first.h"
#include "radiosity/paper/sampling/rng.h"
#include "support/catch.h"

#include <cmath>

using namespace hemilux;

TEST_CASE("The largest of changing numbers, and the first of equal ones") {
    Rng rng(3);
    for (const std::size_t count : {1u, 2u, 3u, 8u, 100u}) {
        LargestFirst order(count);
        std::vector<double> plain(count, 0.0);
        CHECK(order.largest() == 0);
        CHECK(order.index_of_largest() == 0);
        for (int change = 0; change < 500; ++change) {
            const auto at = static_cast<std::size_t>(rng.uniform() * double(count));
            plain[at] = std::floor(10 * rng.uniform()); // few values: often equal
            order.set(at, plain[at]);
            const auto largest = std::ranges::max_element(plain);
            REQUIRE(order.largest() == *largest);
            REQUIRE(order.index_of_largest() == static_cast<std::size_t>(largest - plain.begin()));
        }
    }
}
