// Solver::save and load, for all methods that say that they have them.

#include "radiosity/engine/saving/state.h"
#include "support/catch.h"
#include "support/same_solution.h"
#include "support/scenes.h"
#include "support/solve.h"

using namespace hemilux;

TEST_CASE("a solver that loads a state goes on as the one that saved it", "[state]") {
    const test::Model model(test::open_scene());
    SolveOptions options;
    options.rays = 10;
    options.seed = 5;
    Monitor monitor;
    const SolverInput input{model.mesh, model.bvh, options, monitor};
    int resumable = 0;
    for (const Method* const method : methods()) {
        CAPTURE(method->name);
        const auto first = method->make(input);
        StateWriter saved;
        if (!method->can_resume()) {
            StateReader nothing("");
            CHECK_THROWS_AS(first->save(saved), std::logic_error);
            CHECK_THROWS_AS(first->load(nothing), std::logic_error);
            continue;
        }
        ++resumable;
        run(*first, input, test::steps(3));
        first->save(saved);
        const auto second = method->make(input);
        StateReader state(saved.bytes());
        second->load(state);
        CHECK_NOTHROW(state.expect_end());
        for (const auto& solver : {first.get(), second.get()})
            for (int step = 0; step < 2; ++step)
                REQUIRE(solver->step());
        const Solution &a = first->solution(), &b = second->solution();
        test::check_same_estimates(a, b);
        CHECK(a.energy.escaped == b.energy.escaped);

        const std::string half = saved.bytes().substr(0, saved.bytes().size() / 2);
        StateReader truncated(half);
        CHECK_THROWS_AS(method->make(input)->load(truncated), StateError);
    }
    CHECK(resumable >= 5);
}
