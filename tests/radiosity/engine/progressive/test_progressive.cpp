// Progressive radiosity against the matrix, its energy, and its options.
#include "radiosity/engine/factors/pairs/pair_factor.h"
#include "radiosity/engine/progressive/progressive_pass.h"
#include "radiosity/engine/solving/one_shot.h"
#include "radiosity/engine/solving/own_options.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <cmath>

using namespace hemilux;
using test::Model;

namespace {

SolveOptions coarse(double rays = 64) {
    SolveOptions options;
    options.rays = rays;
    options.seed = 9;
    return options;
}

/// One pass.
Solution to_the_end(const Model& model, const ProgressiveOptions& chosen,
                    SolveOptions options = coarse(), std::uint32_t* steps = nullptr) {
    set_own_options(options, chosen);
    set_own_options(options, OneShotOptions{.one_shot = true});
    Monitor monitor;
    const SolverInput input{model.mesh, model.bvh, options, monitor};
    const auto solver = find_method("progressive")->make(input);
    run(*solver, input, test::steps(1'000'000));
    CHECK(solver->finished());
    if (steps)
        *steps = solver->solution().steps;
    return solver->solution();
}

double error(const Model& model, const Solution& a, const Solution& b) {
    return true_error(model.mesh, a.radiosity, b.radiosity).all;
}

} // namespace

TEST_CASE("Progressive radiosity agrees with the matrix, pass by pass", "[slow]") {
    for (const Scene& scene : {test::room_with_block(), test::open_scene()}) {
        const Model model(scene);
        const Solution exact = test::reference(model, .001);
        const Method& method = *find_method("progressive");
        const Solution first = to_the_end(model, {});
        CHECK(error(model, first, exact) < .04);
        const Solution s =
            test::solve(model, method, coarse(), {.steps = {}, .seconds = {}, .error = .0015});
        CHECK(error(model, s, exact) < .002);
        // Its own estimate is of the right size.
        CHECK(estimated_error(model.mesh, s) > error(model, s, exact) / 2);
        CHECK(s.rays_energy > 4 * first.rays_energy);
    }
}

/// Shelves that nearly touch, in a lit room: little light finds its way between them, and what one
/// shelf gets too much of the other gets from it.
Scene narrow_gap() {
    Scene scene = test::cube_with_lit_floor(2, .5);
    scene.materials.push_back({.name = "shelf", .reflectance = Vec3(.7)});
    const auto shelf = static_cast<std::uint32_t>(scene.materials.size() - 1);
    const double low = .5, high = .52, from = .2, to = .8;
    test::add_quad(scene, {from, low, from}, {from, low, to}, {to, low, to}, {to, low, from}, 4, 4,
                   shelf);
    test::add_quad(scene, {from, high, from}, {to, high, from}, {to, high, to}, {from, high, to}, 4,
                   4, shelf);
    return scene;
}

TEST_CASE("The error of a patch holds what its neighbours in a narrow gap err by", "[slow]") {
    const Model model(narrow_gap());
    const Solution exact = test::reference(model, .001);
    double squares = 0, count = 0;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        SolveOptions options = coarse(16);
        options.seed = seed;
        const Solution s = to_the_end(model, {}, options);
        for (std::size_t i = 24; i < s.radiosity.size(); ++i) { // the gap
            const double z = (s.radiosity[i].y - exact.radiosity[i].y) / s.standard_error[i].y;
            squares += z * z;
            ++count;
        }
    }
    CAPTURE(squares / count);
    CHECK(squares / count < 2.5); // 3.8 where shooters are taken for exact
    CHECK(squares / count > .3);
}

TEST_CASE("Progressive radiosity accounts for all energy") {
    for (const Scene& scene :
         {test::room_with_block(), test::open_scene(), test::cube_with_lit_floor(3, .5)}) {
        const Model model(scene);
        const Solution s = to_the_end(model, {}, coarse(16));
        for (int c = 0; c < 3; ++c)
            CHECK(s.energy.absorbed[c] + s.energy.escaped[c] ==
                  Approx(s.energy.emitted[c]).epsilon(.04)); // the rest is unshot, by chance
        CHECK(s.energy.imbalance() < 1e-12);
    }
}

TEST_CASE("Progressive radiosity shoots the brightest patch first, one at a time if asked") {
    const Model model(test::cube_with_lit_floor(3, .5)); // the first nine patches emit
    Monitor monitor;
    SolveOptions options = coarse();
    set_own_options(options, OneShotOptions{.one_shot = true});
    const SolverInput input{model.mesh, model.bvh, options, monitor};
    const auto solver = find_method("progressive")->make(input);
    double before = 0;
    for (int shot = 0; shot < 9; ++shot) {
        REQUIRE(solver->step());
        const Solution& s = solver->solution();
        double light = 0;
        for (std::size_t i = 0; i < s.radiosity.size(); ++i) {
            light += model.mesh.patches()[i].area * s.radiosity[i].x;
            CHECK(s.radiosity[i].x == Approx(i < 9 ? 1.0 : s.radiosity[i].x));
        }
        CHECK(light > before);
        before = light;
    }
    // All direct light, at half reflectance: the floor's mean factor to the rest is 1.
    const double floor = model.mesh.patches()[0].area * 9;
    CHECK(before == Approx(floor * 1.5).epsilon(.01));
    CHECK(solver->step()); // now the walls
    CHECK_FALSE(solver->finished());
}

TEST_CASE("The ambient term makes early solutions better and is gone at the end") {
    const Model model(test::room_with_block());
    const SolveOptions options = coarse(8);
    const Solution end = to_the_end(model, {}, options);
    const auto early = [&](bool ambient) {
        SolveOptions chosen = options;
        set_own_options(chosen, OneShotOptions{.one_shot = true});
        set_own_options(chosen, ProgressiveOptions{.ambient = ambient});
        Monitor monitor;
        const SolverInput input{model.mesh, model.bvh, chosen, monitor};
        const auto solver = find_method("progressive")->make(input);
        run(*solver, input, test::steps(40));
        CHECK_FALSE(solver->finished());
        return solver->solution();
    };
    CHECK(error(model, early(true), end) < .7 * error(model, early(false), end));
    CHECK(error(model, to_the_end(model, {.ambient = true, .overshoot = false}, options), end) <
          1e-4);
}

TEST_CASE("Overshooting gives the same solution with fewer shots in a bright room", "[slow]") {
    Scene scene = test::room_with_block();
    for (Material& m : scene.materials)
        m.reflectance = glm::mix(m.reflectance, Vec3(.95), .7);
    const Model model(scene);
    std::uint32_t plain_steps = 0, steps = 0;
    ProgressiveOptions chosen{.ambient = false, .overshoot = false};
    const Solution plain = to_the_end(model, chosen, coarse(1024), &plain_steps);
    chosen.overshoot = true;
    const Solution s = to_the_end(model, chosen, coarse(1024), &steps);
    CHECK(error(model, s, plain) < .015);
    CAPTURE(steps, plain_steps);
    CHECK(steps < .8 * plain_steps);
}

TEST_CASE("The factor of a pair and its standard error against the closed form") {
    // Floor and ceiling of a unit cube (Howell C-11), floor and wall (C-14).
    const Model model(test::cube_with_lit_floor(1, .5));
    const auto check = [&](std::uint32_t from, std::uint32_t to, double exact) {
        double mean = 0, variance = 0, squares = 0;
        constexpr int runs = 50;
        for (std::uint64_t seed = 0; seed < runs; ++seed) {
            const PairFactor f = pair_factor(model.mesh, model.bvh, from, to, 64, seed);
            mean += f.factor / runs;
            variance += f.variance / runs;
            squares += (f.factor - exact) * (f.factor - exact) / runs;
        }
        CHECK(mean == Approx(exact).epsilon(.01));
        CHECK(variance / squares > .2); // to stop when the sets agree is to stop a little early
        CHECK(variance / squares < 4);  // and is reported as if it were the error allowed
    };
    check(0, 1, .19982490);
    check(0, 2, .20004378);
    CHECK_FALSE(may_see(model.mesh.patches()[0], model.mesh.patches()[0]));
    CHECK(may_see(model.mesh.patches()[0], model.mesh.patches()[3]));
}

TEST_CASE("The factor of a pair that sees each other through a slit is right on average") {
    Scene scene = test::cube_with_lit_floor(1, .5);
    for (const auto& [low, high] : {std::pair{0.0, .48}, {.52, 1.0}})
        test::add_quad(scene, {low, .5, 0}, {high, .5, 0}, {high, .5, 1}, {low, .5, 1}, 1, 1, 0);
    const Model model(scene);
    struct Mean {
        double value = 0, variance = 0, reported = 0;
    };
    const auto mean_of = [&](double importance) {
        constexpr int runs = 20'000;
        double sum = 0, squares = 0, reported = 0;
        for (std::uint64_t seed = 0; seed < runs; ++seed) {
            const PairFactor f = pair_factor(model.mesh, model.bvh, 0, 1, importance, seed);
            sum += f.factor;
            squares += f.factor * f.factor;
            reported += f.variance / runs;
        }
        return Mean{sum / runs, (squares - sum * sum / runs) / runs, reported};
    };
    const Mean fixed = mean_of(31), adaptive = mean_of(40); // as many points each time, or not
    const double sigma = std::sqrt((fixed.variance + adaptive.variance) / 20'000);
    CAPTURE(fixed.value, adaptive.value, adaptive.variance, adaptive.reported);
    CHECK(std::abs(adaptive.value - fixed.value) < 4.5 * sigma); // two-sided 7e-6
    CHECK(adaptive.reported / adaptive.variance > .5);
    CHECK(adaptive.reported / adaptive.variance < 4);
}

TEST_CASE("Progressive radiosity of rooms that reflect nothing or hold no light") {
    Scene scene = test::cube_with_lit_floor(2, 0);
    const Solution black = to_the_end(Model(scene), {});
    for (std::size_t i = 0; i < black.radiosity.size(); ++i)
        CHECK(black.radiosity[i].x == (i < 4 ? 1 : 0));
    CHECK(black.energy.absorbed.x == Approx(1).epsilon(.005));
    for (Material& m : scene.materials)
        m.emission = Vec3(0.0);
    const Solution dark = to_the_end(Model(scene), {});
    CHECK(dark.rays_energy == 0);
    CHECK(dark.radiosity[0] == Vec3(0.0));
}

TEST_CASE("Patches with the same centre have a rough factor") {
    Scene scene;
    scene.materials = {{"lamp", Vec3(.5), Vec3(1.0)}};
    scene.groups = {"default"};
    test::add_quad(scene, {-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, 1, 1, 0);
    test::add_quad(scene, {0, -1, -1}, {0, -1, 1}, {0, 1, 1}, {0, 1, -1}, 1, 1, 0);
    const Model model(scene);
    CHECK(rough_factor(model.mesh.patches()[0], model.mesh.patches()[1]) > .5);
    CHECK(to_the_end(model, {}).radiosity[0].x > 1);
}
