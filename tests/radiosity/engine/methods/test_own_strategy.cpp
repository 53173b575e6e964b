// That a strategy is one file: see tests/CMakeLists.txt, which lists one of examples/ for this
// program, and test_strategies.cpp and test_methods.cpp, which then test it as all others.
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"

using namespace hemilux;

TEST_CASE("An added strategy is a method like all others") {
    const Method* const method = find_method("equal-rays");
    REQUIRE(method != nullptr);
    REQUIRE(find_method("hemisphere") != nullptr);
    const test::Model model(test::room_with_block());
    const Solution exact = test::reference(model, .01);
    const Solution s = test::solve(model, *method, {}, test::steps(32));
    const ZScores z = z_scores(model.mesh, s, exact.radiosity, exact.standard_error);
    CHECK(z.count > 100);
    CHECK(z.rms == Approx(1).margin(.2));
    CHECK(std::abs(z.mean) < .3);
}
