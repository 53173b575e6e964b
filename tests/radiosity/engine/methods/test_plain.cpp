// The engine against the pages of src/radiosity/paper/pages: the same bits where the random numbers
// are the same, within standard errors where the engine draws others.
#include "radiosity/engine/densities/subdivision_1997.h"
#include "radiosity/engine/needs/find_needs.h"
#include "radiosity/engine/solving/own_options.h"
#include "support/catch.h"
#include "support/example_scenes.h"
#include "support/scenes.h"
#include "support/solve.h"
#include "support/statistics.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

using namespace hemilux;
using test::example_scene;
using test::Model;

namespace {

Solution solve_plainly(const Model& model, const Method& method, const SolveOptions& options,
                       const StopRule& stop) {
    Monitor monitor;
    const SolverInput input{model.mesh, model.bvh, options, monitor};
    const auto solver = method.plain(input);
    run(*solver, input, stop);
    return solver->solution();
}

/// All that a patch table holds, to the last bit, and what a run reports.
void check_same(const Model& model, const Method& method, const SolveOptions& options,
                std::uint32_t steps) {
    CAPTURE(method.name, options.rays, options.depth, options.threshold, options.literal, steps);
    const Solution plain = solve_plainly(model, method, options, test::steps(steps));
    const Solution engine = test::solve(model, method, options, test::steps(steps));
    CHECK(test::same_bits(plain.radiosity, engine.radiosity));
    if (steps > 1)
        CHECK(test::same_bits(plain.standard_error, engine.standard_error));
    CHECK(plain.hits == engine.hits);
    CHECK(plain.variance == engine.variance);
    CHECK(plain.missed == engine.missed);
    CHECK(plain.effective_freedom == engine.effective_freedom);
    CHECK(plain.steps == engine.steps);
    CHECK(plain.rays_energy == engine.rays_energy);
    CHECK(plain.rays_density == engine.rays_density);
    // Sums over rays are taken in another order.
    const double emitted = glm::length(engine.energy.emitted);
    CHECK(plain.energy.emitted == engine.energy.emitted);
    CHECK(glm::length(plain.energy.absorbed - engine.energy.absorbed) <= 1e-12 * emitted);
    CHECK(glm::length(plain.energy.escaped - engine.energy.escaped) <= 1e-12 * emitted);
    CHECK(glm::length(plain.energy.unshot - engine.energy.unshot) <= 1e-12 * emitted);
}

SolveOptions with_rays(double rays, bool literal = false) {
    SolveOptions options;
    options.rays = rays;
    options.literal = literal;
    options.seed = 11;
    return options;
}

const Method& method(const char* name) { return *find_method(name); }

/// Whether the page draws the engine's random numbers: those that shoot do.
bool has_same_bits(const Method& one) {
    return one.plain && one.name != "matrix" && one.name != "progressive" &&
           one.name != "stored-transport";
}

} // namespace

TEST_CASE("Section 5 on one page has the engine's bits") {
    for (const bool literal : {false, true}) {
        const SolveOptions options = with_rays(6, literal);
        check_same(Model(example_scene("room_1002")), method("hemisphere"), options, 2);
        check_same(Model(example_scene("cornell_box")), method("hemisphere"), options, 2);
        check_same(Model(test::open_scene()), method("hemisphere"), with_rays(50, literal), 3);
        check_same(Model(test::furnace_box(3, .5)), method("hemisphere"), with_rays(20, literal),
                   3);
    }
}

TEST_CASE("Section 5 on one page: depths and thresholds") {
    const Model model(test::room_with_block());
    SolveOptions options = with_rays(15);
    for (options.depth = 0; options.depth <= 4; ++options.depth)
        for (const double threshold : {0.0, 1.5, 4.0}) {
            options.threshold = threshold;
            options.literal = threshold == 1.5;
            check_same(model, method("hemisphere"), options, 2);
        }
}

TEST_CASE("Sections 3.2, 3.3 and 4 on a page have the engine's bits") {
    for (const char* name : {"monte-carlo", "progressive-monte-carlo"}) {
        check_same(Model(example_scene("room_1002")), method(name), with_rays(3), 2);
        check_same(Model(test::open_scene()), method(name), with_rays(50), 4);
        check_same(Model(test::furnace_box(3, .5)), method(name), with_rays(20), 3);
    }
    const Method& of_1997 = method("hemisphere-1997");
    for (const bool literal : {false, true}) {
        check_same(Model(test::room_with_block()), of_1997, with_rays(40, literal),
                   literal ? 1 : 5);
        check_same(Model(test::open_scene()), of_1997, with_rays(20, literal), 4);
    }
}

TEST_CASE("Section 4 on a page has the engine's bits for other numbers of parts and steps",
          "[slow]") {
    const Method& of_1997 = method("hemisphere-1997");
    for (const Subdivision1997Options& numbers :
         {Subdivision1997Options{1, 2, 1}, {3, 0, 4}, {0, 2, 16}, {0, 0, 64}, {1, 1, 64}})
        for (const bool literal : {false, true}) {
            SolveOptions options = with_rays(30, literal);
            set_own_options(options, numbers);
            CAPTURE(numbers.stored_steps, numbers.estimated_steps, numbers.parts);
            check_same(Model(test::furnace_l_shape(.5)), of_1997, options, 4);
        }
    check_same(Model(test::sphere(1, 1, .5, 1)), of_1997, with_rays(300), 4);
    check_same(Model(example_scene("room_1002")), of_1997, with_rays(6), 4);
}

TEST_CASE("Every page ends a run at once where nothing reflects") {
    Scene scene = test::room_with_block();
    for (Material& material : scene.materials)
        material.reflectance = Vec3(0.0);
    const Model model(std::move(scene));
    Monitor monitor;
    const Needs needs = find_needs(model.mesh);
    const SolveOptions options = with_rays(4);
    const SolverInput input{model.mesh, model.bvh, options, monitor, needs};
    for (const Method* const one : methods()) {
        if (!one->plain || one == &method("stored-transport"))
            continue;
        CAPTURE(one->name);
        const auto solver = one->plain(input), engine = one->make(input);
        run(*solver, input, test::steps(3));
        run(*engine, input, test::steps(3));
        CHECK(solver->solution().steps == 1);
        CHECK(test::same_bits(solver->solution().radiosity, engine->solution().radiosity));
        CHECK(
            test::same_bits(solver->solution().standard_error, engine->solution().standard_error));
    }
}

TEST_CASE("A page that is interrupted has the solution of the steps before") {
    const Model model(test::room_with_block());
    const SolveOptions options = with_rays(4);
    for (const Method* const one : methods()) {
        if (!one->plain)
            continue;
        CAPTURE(one->name);
        Monitor monitor;
        const SolverInput input{model.mesh, model.bvh, options, monitor};
        const auto solver = one->plain(input);
        REQUIRE(solver->step());
        const std::vector<Vec3> before = solver->solution().radiosity;
        monitor.interrupted.set_wished(true);
        CHECK_FALSE(solver->step());
        CHECK(solver->solution().steps == 1);
        CHECK(test::same_bits(solver->solution().radiosity, before));
    }
}

TEST_CASE("Sections 2 and 3.1 on a page agree with the matrix of the engine") {
    const Model model(test::room_with_block());
    const Solution engine = test::reference(model, .005);
    const auto check = [&](const char* name, double rays, std::uint32_t steps) {
        CAPTURE(name);
        constexpr int runs = 4;
        double squares = 0, reported = 0;
        for (std::uint64_t seed = 1; seed <= runs; ++seed) {
            SolveOptions options = with_rays(rays);
            options.seed = seed;
            const Solution s = solve_plainly(model, method(name), options, test::steps(steps));
            const double off = true_error(model.mesh, s.radiosity, engine.radiosity).all;
            const double error = estimated_error(model.mesh, s);
            squares += off * off / runs;
            reported += error * error / runs;
        }
        CAPTURE(std::sqrt(squares), std::sqrt(reported));
        CHECK(reported < .25 * .25);
        CHECK(squares > .6 * .6 * reported);
        CHECK(squares < 1.5 * 1.5 * reported);
    };
    check("matrix", 512, 2);
    check("progressive", 4, 100'000); // ends when nearly all is shot
}

TEST_CASE("Stored transport on one page keeps furnaces exactly") {
    for (const Scene& scene : {test::furnace_box(3, .5), test::furnace_l_shape(.8)}) {
        const Model model(scene);
        const double rho = model.mesh.material(0).reflectance.x;
        const Solution s =
            solve_plainly(model, method("stored-transport"), with_rays(16), test::steps(2));
        double largest = 0;
        for (const Vec3& B : s.radiosity)
            largest = std::max(largest, glm::length(B - Vec3(1 / (1 - rho))));
        CHECK(largest < 1e-9);
    }
}

TEST_CASE("Stored transport on one page agrees with its engine", "[slow]") {
    const Model model(test::room_with_block());
    SolveOptions many = with_rays(64);
    many.seed = 99;
    const Solution engine = test::solve(model, method("stored-transport"), many,
                                        {.steps = {}, .seconds = {}, .error = 1e-3});
    const std::size_t patches = model.mesh.patches().size(), runs = 12;
    std::vector<test::MeanTest> means(3 * patches);
    double squares = 0, reported = 0;
    for (std::uint64_t seed = 1; seed <= runs; ++seed) {
        SolveOptions options = with_rays(512);
        options.seed = seed;
        const Solution s =
            solve_plainly(model, method("stored-transport"), options, test::steps(2));
        for (std::size_t k = 0; k < means.size(); ++k)
            means[k].add(s.radiosity[k / 3][int(k % 3)]);
        const double off = true_error(model.mesh, s.radiosity, engine.radiosity).all;
        const double error = estimated_error(model.mesh, s);
        squares += off * off;
        reported += error * error;
        CHECK(s.energy.imbalance() < 1e-9);
    }
    double least = 1;
    for (std::size_t k = 0; k < means.size(); ++k)
        if (means[k].standard_error() > 0)
            least = std::min(least, means[k].p_value(engine.radiosity[k / 3][int(k % 3)]));
    CHECK(least > test::sidak(test::significance, means.size()));
    CHECK(std::sqrt(squares / reported) > .5);
    CHECK(std::sqrt(squares / reported) < 1.5);
}

TEST_CASE("Pages have the engine's bits on 3576 patches", "[slow]") {
    const Model model(example_scene("office_3576"));
    for (const Method* const one : methods())
        if (has_same_bits(*one)) {
            check_same(model, *one, with_rays(8), 2);
            if (one->has_literal)
                check_same(model, *one, with_rays(8, true), 1);
        }
}
