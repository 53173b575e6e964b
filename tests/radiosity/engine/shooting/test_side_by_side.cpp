// Steps that are worked out at the same time: nobody can tell from the solution.

#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"
#include "support/watched_tracer.h"

#include <stdexcept>

using namespace hemilux;
using test::Model;

namespace {

SolveOptions options_of(unsigned threads, const StopRule& stop) {
    SolveOptions options;
    options.rays = 24;
    options.threads = threads;
    options.stop = stop;
    return options;
}

void check_same(const Solution& a, const Solution& b) {
    CHECK(test::same_bits(a.radiosity, b.radiosity));
    CHECK(test::same_bits(a.standard_error, b.standard_error));
    CHECK(a.hits == b.hits);
    CHECK(a.rays_energy == b.rays_energy);
    CHECK(a.energy.escaped == b.energy.escaped);
}

} // namespace

TEST_CASE("Steps side by side are those that one thread finds one after the other") {
    const Model model(test::room_with_block());
    for (const Method* method : methods()) {
        if (!method->strategy && method->name != "monte-carlo")
            continue; // their steps build on each other
        const Solution alone = test::solve(model, *method, options_of(1, {}), test::steps(5));
        for (const unsigned threads : {2u, 3u}) {
            CAPTURE(method->name, threads);
            check_same(
                test::solve(model, *method, options_of(threads, test::steps(5)), test::steps(5)),
                alone);
        }
    }
}

TEST_CASE("Steps side by side end at an error as one after the other") {
    const Model model(test::room_with_block());
    const Method& method = *find_method("hemisphere");
    SolveOptions options = options_of(1, {});
    const StopRule stop{.steps = {}, .seconds = {}, .error = .05};
    const Solution alone = test::solve(model, method, options, stop);
    options = options_of(3, stop);
    check_same(test::solve(model, method, options, stop), alone);
}

TEST_CASE("A run of steps side by side goes on where it was interrupted") {
    const Model model(test::room_with_block());
    const SolveOptions options = options_of(2, test::steps(6));
    for (const char* name : {"hemisphere", "monte-carlo"}) {
        const Method& method = *find_method(name);
        const Solution whole = test::solve(model, method, options, test::steps(6));
        for (const int streams : {1, 40, 90}) {
            CAPTURE(name, streams);
            Monitor monitor;
            const test::AfterStreams tracer(model.bvh, streams,
                                            [&] { monitor.interrupted.set_wished(true); });
            const auto solver = method.make({model.mesh, tracer, options, monitor});
            while (solver->solution().steps < 6)
                if (!solver->step())
                    REQUIRE(monitor.interrupted.own().wished.exchange(false));
            check_same(solver->solution(), whole);
        }
    }
}

TEST_CASE("What goes wrong in one of the steps side by side leaves those before it") {
    const Model model(test::room_with_block());
    const SolveOptions options = options_of(2, test::steps(100));
    Monitor monitor;
    const test::AfterStreams tracer(model.bvh, 200, [] { throw std::runtime_error("no more"); });
    const auto solver = find_method("stratified")->make({model.mesh, tracer, options, monitor});
    std::uint32_t steps = 0;
    CHECK_THROWS_AS(
        [&] {
            for (; steps < 100; ++steps)
                solver->step();
        }(),
        std::runtime_error);
    CHECK(steps > 0);
    check_same(solver->solution(),
               test::solve(model, *find_method("stratified"), options, test::steps(steps)));
}

TEST_CASE("What is worked out when a run is interrupted is not lost") {
    const Model model(test::room_with_block());
    const Method& method = *find_method("stratified");
    const SolveOptions options = options_of(2, test::steps(100));
    Monitor monitor;
    const SolverInput input{model.mesh, model.bvh, options, monitor};
    const auto solver = method.make(input);
    std::uint32_t ready = 0, at = 0;
    CHECK_FALSE(
        run(*solver, input, test::steps(100), [&](const StepRecord& record, const Solution&) {
            if (ready > 0)
                return;
            ready = solver->steps_ready();
            at = record.step;
            monitor.interrupted.set_wished(ready > 0);
        }));
    CHECK(ready > 0);
    CHECK(solver->solution().steps == at + ready);
    check_same(solver->solution(),
               test::solve(model, method, options_of(1, {}), test::steps(at + ready)));
}
