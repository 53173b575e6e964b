// How well the errors that methods report are known: what they say of it, and what seeds show.
#include "radiosity/paper/solution/error_spread.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <cmath>

using namespace hemilux;

TEST_CASE("Methods say how well their error is known") {
    const test::Model model(test::room_with_block());
    for (const char* name : {"stored-transport", "hemisphere", "matrix"}) {
        const Solution s = test::solve(model, *find_method(name), {}, test::steps(3));
        const ErrorSpread spread = error_spread(model.mesh, s);
        CAPTURE(name, spread.freedom);
        CHECK(spread.freedom > 1);
        CHECK(spread.uncertainty() > 0);
        CHECK(spread.uncertainty() < .5);
    }
}

TEST_CASE("Reported errors differ between seeds about as much as they say", "[slow]") {
    const test::Model model(test::room_with_block());
    for (const char* name : {"stored-transport", "hemisphere", "monte-carlo", "matrix"}) {
        double mean = 0, squares = 0, reported = 0;
        constexpr int seeds = 16;
        for (int seed = 1; seed <= seeds; ++seed) {
            SolveOptions options;
            options.seed = static_cast<std::uint64_t>(seed);
            options.rays = 32;
            const Solution s = test::solve(model, *find_method(name), options, test::steps(3));
            const double error = estimated_error(model.mesh, s);
            mean += error / seeds;
            squares += error * error / seeds;
            reported += error * error_spread(model.mesh, s).uncertainty() / seeds;
        }
        const double spread = std::sqrt((squares - mean * mean) * seeds / (seeds - 1));
        CAPTURE(name, mean, spread, reported);
        CHECK(reported > spread / 2.5);
        CHECK(reported < spread * 2.5);
    }
}
