// Proof of the estimators: every unbiased method against the reference, patch by patch, on scenes
// with occlusion, within the standard errors that both report.
#include "io/obj.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

using namespace hemilux;
using test::Model;

namespace {

Scene example(const std::string& name) {
    return read_obj(std::string(HEMILUX_SOURCE_DIR) + "/examples/scenes/" + name + ".obj").scene;
}

} // namespace

TEST_CASE("Deviations from matrix are those of the reported standard errors", "[slow]") {
    constexpr int runs = 4;
    for (const std::string scene :
         {"cornell_box", "room_1002", "open_scene", "wall_before_crowd"}) {
        const Model model(example(scene));
        const Solution exact = test::reference(model, .002);
        for (const Method* method : methods()) {
            if (!method->unbiased)
                continue;
            // One run's mean over some 900 patches of correlated channels is itself uncertain by
            // .03, its RMS by .03 too; now and then a patch that few rays strike adds .05.
            double mean = 0, squares = 0;
            for (int run = 0; run < runs; ++run) {
                SolveOptions options;
                options.seed = 31 + std::uint64_t(run);
                const Solution s = test::solve(model, *method, options, test::steps(64));
                const ZScores z = z_scores(model.mesh, s, exact.radiosity, exact.standard_error);
                CAPTURE(scene, method->name, run, z.mean, z.rms, z.count);
                CHECK(z.count > 1500);
                CHECK(z.rms > .85);
                CHECK(z.rms < 1.15);
                mean += z.mean / runs;
                squares += z.rms * z.rms / runs;
            }
            CAPTURE(scene, method->name, mean, std::sqrt(squares));
            CHECK(std::abs(mean) < .05);
            CHECK(std::sqrt(squares) > .93);
            CHECK(std::sqrt(squares) < 1.07);
        }
    }
}

TEST_CASE("The estimated error is the true one, from the fourth step on", "[slow]") {
    constexpr int runs = 6;
    for (const std::string scene :
         {"cornell_box", "room_1002", "open_scene", "wall_before_crowd"}) {
        const Model model(example(scene));
        const Solution exact = test::reference(model, .004);
        for (const Method* method : methods()) {
            if (!method->unbiased)
                continue;
            // Both are random, so one run's ratio may be off by a fifth where few patches hold most
            // of the error.
            double early = 0, late = 0;
            for (int run = 0; run < runs; ++run) {
                SolveOptions options;
                options.seed = 131 + std::uint64_t(run);
                Monitor monitor;
                const SolverInput input{model.mesh, model.bvh, options, monitor};
                const auto solver = method->make(input);
                const auto ratio = [&](const Solution& s) {
                    return std::log(estimated_error(model.mesh, s) /
                                    true_error(model.mesh, s.radiosity, exact.radiosity).all) /
                           runs;
                };
                hemilux::run(*solver, input, test::steps(8),
                             [&](const StepRecord& record, const Solution& s) {
                                 if (record.step == 4)
                                     early += ratio(s);
                                 if (record.step == 8)
                                     late += ratio(s);
                             });
            }
            CAPTURE(scene, method->name, std::exp(early), std::exp(late));
            CHECK(std::exp(early) > .8);
            CHECK(std::exp(early) < 1.25);
            CHECK(std::exp(late) > .85);
            CHECK(std::exp(late) < 1.15);
        }
    }
}

TEST_CASE("The error falls as one over the root of the rays, over three decades", "[slow]") {
    const Model model(test::room_with_block());
    const Solution exact = test::reference(model, .0006);
    for (const Method* method : methods()) {
        if (!method->unbiased)
            continue;
        Monitor monitor;
        SolveOptions options;
        options.rays = 16;
        const SolverInput input{model.mesh, model.bvh, options, monitor};
        const auto solver = method->make(input);
        std::vector<double> scaled; // error sqrt(rays): constant if there is no floor
        run(*solver, input, test::steps(4000), [&](const StepRecord& record, const Solution& s) {
            if (record.step == 4 || record.step == 40 || record.step == 400 || record.step == 4000)
                scaled.push_back(true_error(model.mesh, s.radiosity, exact.radiosity).all *
                                 std::sqrt(double(s.rays_energy)));
        });
        CAPTURE(method->name, scaled);
        REQUIRE(scaled.size() == 4);
        for (const double value : scaled)
            CHECK(value == Approx(scaled[0]).epsilon(.25));
    }
}

TEST_CASE("Plain Monte Carlo has its known error on the lit cube", "[slow]") {
    // V[B_i] = rho_i Phi_T (B_i - E_i) / (A_i N) makes error sqrt(N) = 9.29.
    const Model model(test::cube_with_lit_floor(4, .5));
    const Solution exact = test::reference(model, .0002);
    constexpr int runs = 60;
    double squares = 0;
    for (int run = 0; run < runs; ++run) {
        SolveOptions options;
        options.rays = 200;
        options.seed = 500 + std::uint64_t(run);
        const Solution s =
            test::solve(model, *find_method("progressive-monte-carlo"), options, test::steps(8));
        const double error = true_error(model.mesh, s.radiosity, exact.radiosity).all;
        squares += error * error * double(s.rays_energy) / runs;
    }
    CHECK(std::sqrt(squares) == Approx(9.29).epsilon(.05));
}

TEST_CASE("The reference tells its own error", "[slow]") {
    const Model model(test::room_with_block());
    const Solution fine = test::reference(model, .0006);
    SolveOptions options;
    options.seed = 4;
    const Method& matrix = *find_method("matrix");
    for (const std::uint32_t n : {1u, 3u}) {
        const Solution coarse = test::solve(model, matrix, options, test::steps(n));
        const double truth = true_error(model.mesh, coarse.radiosity, fine.radiosity).all;
        CAPTURE(n, truth);
        CHECK(estimated_error(model.mesh, coarse) / truth > .7);
        CHECK(estimated_error(model.mesh, coarse) / truth < 1.4);
    }
}
