// The engine against the pages of src/radiosity/plain: the same bits where the random numbers are
// the same, within standard errors for gathering.
#include "io/obj.h"
#include "support/scenes.h"
#include "support/solve.h"
#include "support/statistics.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <string>

using namespace hemilux;
using test::Model;

namespace {

Scene example(const std::string& name) {
    return read_obj(std::string(HEMILUX_SOURCE_DIR) + "/examples/scenes/" + name + ".obj").scene;
}

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
    CHECK(plain.unseen == engine.unseen);
    CHECK(plain.error_parts == engine.error_parts);
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

} // namespace

TEST_CASE("Section 5 on one page has the engine's bits") {
    for (const bool literal : {false, true}) {
        const SolveOptions options = with_rays(6, literal);
        check_same(Model(example("room_1002")), method("hemisphere"), options, 2);
        check_same(Model(example("cornell_box")), method("hemisphere"), options, 2);
        check_same(Model(test::open_scene()), method("hemisphere"), with_rays(50, literal), 3);
        check_same(Model(test::furnace_box(3, .5)), method("hemisphere"), with_rays(20, literal),
                   3);
    }
}

TEST_CASE("Section 5 on one page: depths and thresholds") {
    const Model model(test::room_with_block());
    SolveOptions options = with_rays(30);
    for (options.depth = 0; options.depth <= 4; ++options.depth)
        for (const double threshold : {0.0, 1.5, 4.0}) {
            options.threshold = threshold;
            options.literal = threshold == 1.5;
            check_same(model, method("hemisphere"), options, 2);
        }
}

TEST_CASE("Sections 3.2, 3.3 and 4 on a page have the engine's bits") {
    for (const char* name : {"monte-carlo", "progressive-monte-carlo"}) {
        check_same(Model(example("room_1002")), method(name), with_rays(6), 2);
        check_same(Model(test::open_scene()), method(name), with_rays(50), 4);
        check_same(Model(test::furnace_box(3, .5)), method(name), with_rays(20), 3);
    }
    const Method& of_1997 = method("hemisphere-1997");
    for (const bool literal : {false, true}) {
        check_same(Model(test::room_with_block()), of_1997, with_rays(80, literal), 5);
        check_same(Model(test::open_scene()), of_1997, with_rays(20, literal), 5);
        check_same(Model(test::sphere(1, 1, .5, 1)), of_1997, with_rays(300, literal), 4);
    }
    check_same(Model(example("room_1002")), of_1997, with_rays(6), 4);
}
