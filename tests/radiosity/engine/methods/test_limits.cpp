// What a small file or a large option may cost: counted, or ended by the time of the run.
#include "radiosity/engine/solving/time_limit.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"
#include "support/watched_tracer.h"

#include <atomic>
#include <functional>
#include <sys/resource.h>
#include <thread>

using namespace hemilux;
using test::Model;

namespace {

/// Sanitizers have memory of their own, so their builds do not ask.
[[maybe_unused]] double peak_megabytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

/// Does something when so many shadow rays have been traced.
class AfterShadowRays final : public test::WatchedTracer {
  public:
    AfterShadowRays(const Tracer& tracer, int rays, std::function<void()> what)
        : WatchedTracer(tracer, [](std::span<const Ray>) {}), left_(rays), what_(std::move(what)) {}
    [[nodiscard]] bool occluded(const Ray& ray, std::uint32_t target) const override {
        if (--left_ == 0)
            what_();
        return WatchedTracer::occluded(ray, target);
    }

  private:
    mutable std::atomic<int> left_;
    std::function<void()> what_;
};

} // namespace

TEST_CASE("Rays of a step are listed in parts, however many there are", "[slow]") {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    const Model model(test::room_with_block());
    for (const char* name : {"stratified", "hemisphere", "monte-carlo", "hemisphere-1997"})
        for (const bool literal : {false, true}) {
            const Method& method = *find_method(name);
            if (literal && !method.has_literal)
                continue;
            CAPTURE(name, literal);
            Monitor monitor;
            const test::AfterStreams tracer(model.bvh, 400,
                                            [&] { monitor.interrupted.set_wished(true); });
            const SolveOptions options{.rays = 1e9, .literal = literal, .threads = 1};
            const auto solver = method.make({model.mesh, tracer, options, monitor});
            const double before = peak_megabytes();
            CHECK_FALSE(solver->step());
            CHECK(peak_megabytes() - before < 16);
        }
#endif
}

TEST_CASE("At the end of its time every method leaves the step it is in") {
    const Model model(test::room_with_block());
    for (const Method* const method : methods()) {
        CAPTURE(method->name);
        Monitor monitor;
        const SolveOptions options{.rays = 4e3, .threads = 2};
        const test::AfterStreams tracer(model.bvh, 100,
                                        [&] { monitor.interrupted.set_out_of_time(true); });
        const auto solver = method->make({model.mesh, tracer, options, monitor});
        const bool counts = solver->step(); // progressive: the shots that were done
        CHECK(solver->solution().steps == (counts ? 1 : 0));
        CHECK_FALSE(monitor.interrupted.is_wished());
        CHECK(monitor.rays < 4000 * model.mesh.patches().size());
    }
}

TEST_CASE("The light of a shot that the time has cut short is still to be shot") {
    const Model model(test::room_with_block());
    const Method& method = *find_method("progressive");
    const SolveOptions options{.rays = 256, .threads = 1};
    const auto rays = double(test::solve(model, method, options, test::steps(1)).rays_energy);
    for (const double share : {.7, .8, .9}) {
        CAPTURE(share);
        Monitor monitor;
        const AfterShadowRays tracer(model.bvh, int(share * rays),
                                     [&] { monitor.interrupted.set_out_of_time(true); });
        const auto solver = method.make({model.mesh, tracer, options, monitor});
        REQUIRE(solver->step());
        const EnergyBalance& energy = solver->solution().energy;
        CHECK(energy.imbalance() < 1e-9);
        CHECK(glm::length(energy.unshot) > 0);
    }
}

TEST_CASE("A run to a time ends within its first step", "[slow]") {
    const Model model(test::room_with_block());
    for (const Method* const method : methods()) {
        CAPTURE(method->name);
        Monitor monitor;
        const SolveOptions options{.rays = 1e9, .threads = 2};
        const SolverInput input{model.mesh, model.bvh, options, monitor};
        const auto solver = method->make(input);
        CHECK(run(*solver, input, {.steps = {}, .seconds = .01, .error = {}}));
        CHECK_FALSE(monitor.interrupted);
    }
}

TEST_CASE("A step that the time has cut short is taken anew and gives what it would have given") {
    const Model model(test::room_with_block());
    for (const char* name : {"hemisphere", "monte-carlo", "stored-transport"}) {
        CAPTURE(name);
        const Method& method = *find_method(name);
        const SolveOptions options{.rays = 64, .stop = test::steps(2), .threads = 2};
        const Solution whole = test::solve(model, method, options, test::steps(2));
        Monitor monitor;
        const test::AfterStreams tracer(model.bvh, 3,
                                        [&] { monitor.interrupted.set_out_of_time(true); });
        const auto solver = method.make({model.mesh, tracer, options, monitor});
        while (solver->solution().steps < 2)
            if (!solver->step())
                monitor.interrupted.set_out_of_time(false);
        CHECK(solver->solution().radiosity == whole.radiosity);
    }
}

TEST_CASE("A time limit sets its flag once the time is over, and clears it in the end") {
    StopFlag flag;
    {
        const TimeLimit none(flag, std::nullopt), long_one(flag, 1e300);
        CHECK_FALSE(bool(flag));
    }
    {
        const TimeLimit limit(flag, 0.0);
        while (!flag)
            std::this_thread::yield();
        CHECK(flag.is_out_of_time());
        CHECK_FALSE(flag.is_wished());
    }
    CHECK_FALSE(bool(flag));
}
