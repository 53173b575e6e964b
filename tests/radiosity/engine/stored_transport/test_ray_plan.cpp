// A plan of rays, by itself.
#include "radiosity/engine/needs/find_needs.h"
#include "radiosity/engine/saving/state.h"
#include "radiosity/engine/stored_transport/ray_plan.h"
#include "radiosity/paper/sampling/rng.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"

using namespace hemilux;

TEST_CASE("A plan takes back what it saved, to whatever its rays are rounded when they are split") {
    const test::Model model(test::cube_with_lit_floor(2, .5));
    const Needs needs = find_needs(model.mesh);
    Rng random(4);
    for (int round = 0; round < 300; ++round) {
        const double of_random = 1 + 300 * random.uniform(), to_emitters = 30 * random.uniform();
        const RayGoal goal{.growing = round % 2 == 0, .aim = round % 4 == 0 ? 1e-3 : 0};
        RayPlan plan(model.mesh, needs, of_random, to_emitters, goal);
        for (int step = 0; step < 5; ++step) {
            // Where all of the variance is of one kind, the other gets no ray more.
            const double share = step % 3 == 0 ? random.uniform() : step % 3 - 1;
            plan.grow({.relative = .1, .variance = 1, .variance_from_emitters = share}, 100, 1e9,
                      Workers(1));
            StateWriter state;
            plan.save(state);
            RayPlan other(model.mesh, needs, of_random, to_emitters, goal);
            StateReader reader(state.bytes());
            CHECK_NOTHROW(other.load(reader));
        }
    }
}
