// The hemisphere guided by what is seen: unbiased, honest, and the same for any number of threads.
#include "radiosity/hemisphere.h"
#include "radiosity/strategy.h"
#include "radiosity/workers.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace hemilux;
using test::Model;

namespace {

SolveOptions guided(Guide guide, std::uint64_t seed = 3) {
    SolveOptions options;
    options.guide = guide;
    options.seed = seed;
    return options;
}

const Method& hemisphere_method() { return *find_method("hemisphere"); }

} // namespace

TEST_CASE("Guided by what is seen, no triangle starves and the shares sum to 1") {
    for (const Guide guide : {Guide::visible, Guide::learned})
        for (const Scene& scene : {test::room_with_block(), test::open_scene()})
            for (const int depth : {0, 2, 3}) {
                const Model model(scene);
                SolveOptions options = guided(guide);
                options.depth = depth;
                Monitor monitor;
                const Hemisphere hemisphere(depth);
                const SolverInput input{model.mesh, model.bvh, options, monitor};
                const auto strategy = hemisphere_method().strategy(input, hemisphere, Workers(1));
                std::vector<CellShare> shares;
                double most = 0;
                for (std::uint32_t i = 0; i < model.mesh.patches().size(); ++i) {
                    strategy->deal(i, shares);
                    double power = 0, rays = 0;
                    for (const CellShare& share : shares) {
                        power += share.power;
                        rays += share.rays;
                        CHECK(share.rays >= .5 * share.power * (1 - 1e-12));
                        most = std::max(most, share.rays / share.power);
                    }
                    CHECK(power == Approx(1).epsilon(1e-12));
                    CHECK(rays == Approx(1).epsilon(1e-12));
                }
                CHECK((depth == 0 || most > 1.3)); // it does guide
            }
}

TEST_CASE("What hits tell moves rays, after the step") {
    const Model model(test::room_with_block());
    SolveOptions options = guided(Guide::learned);
    Monitor monitor;
    const Hemisphere hemisphere(2);
    const SolverInput input{model.mesh, model.bvh, options, monitor};
    const auto strategy = hemisphere_method().strategy(input, hemisphere, Workers(1));
    REQUIRE(strategy->learns());
    std::uint32_t smallest = 0;
    const auto patches = model.mesh.patches();
    for (std::uint32_t i = 0; i < patches.size(); ++i)
        if (patches[i].area < patches[smallest].area && model.mesh.material(i).reflectance.x > .2)
            smallest = i;
    std::vector<CellShare> before, during, after;
    strategy->deal(5, before);
    const std::uint16_t cell = before[11].cell;
    strategy->learn(5, cell, std::vector<std::uint32_t>(1000, smallest));
    strategy->deal(5, during);
    strategy->begin_step(1);
    strategy->deal(5, after);
    CHECK(during[11].rays == before[11].rays);
    CHECK(after[11].rays > before[11].rays);
    strategy->deal(6, during);
    strategy->begin_step(2);
    strategy->deal(6, after);
    CHECK(during[11].rays == after[11].rays); // another patch has learned nothing
}

TEST_CASE("Guided by what is seen, threads change nothing") {
    const Model model(test::room_with_block());
    for (const Guide guide : {Guide::visible, Guide::learned}) {
        SolveOptions options = guided(guide);
        options.threads = 1;
        const Solution one = test::solve(model, hemisphere_method(), options, test::steps(3));
        options.threads = 3;
        const Solution three = test::solve(model, hemisphere_method(), options, test::steps(3));
        CHECK(one.radiosity == three.radiosity);
    }
}

TEST_CASE("Guided by what is seen, deviations from matrix are the standard errors", "[slow]") {
    for (const Scene& scene : {test::room_with_block(), test::open_scene()}) {
        const Model model(scene);
        const Solution exact = test::reference(model, .002);
        for (const Guide guide : {Guide::visible, Guide::learned}) {
            double mean = 0, squares = 0;
            constexpr int runs = 6; // of some 100 patches whose channels go together
            for (int run = 0; run < runs; ++run) {
                const Solution s =
                    test::solve(model, hemisphere_method(), guided(guide, 40 + std::uint64_t(run)),
                                test::steps(64));
                const ZScores z = z_scores(model.mesh, s, exact.radiosity, exact.standard_error);
                mean += z.mean / runs;
                squares += z.rms * z.rms / runs;
            }
            CAPTURE(mean, std::sqrt(squares));
            CHECK(std::abs(mean) < .12);
            CHECK(std::sqrt(squares) > .88);
            CHECK(std::sqrt(squares) < 1.12);
        }
    }
}
