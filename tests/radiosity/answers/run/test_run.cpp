// A run is a value: it owns what its solver refers to, and goes on where it ended.
#include "radiosity/answers/run/run.h"
#include "radiosity/answers/run/side_by_side.h"
#include "support/catch.h"
#include "support/scenes.h"

#include <memory>
#include <vector>

using namespace hemilux;

namespace {

std::shared_ptr<const Problem> furnace() {
    Watcher nobody;
    return std::make_shared<const Problem>(
        prepare(std::make_shared<Mesh>(test::furnace_box(1, .5)), {}, {.threads = 1}, nobody));
}

RunChoices by(const char* method, std::uint32_t steps) {
    RunChoices choices{.method = find_method(method)};
    choices.options.threads = 1;
    choices.stop.steps = steps;
    return choices;
}

struct Counting : RunWatcher {
    void step_done(const StepRecord& record, const Solution& solution) override {
        CHECK(record.step == ++steps);
        CHECK(solution.steps == steps);
    }
    [[nodiscard]] bool is_useful(const Solution& solution) override {
        return solution.steps == useful_at;
    }
    std::uint32_t steps = 0, useful_at = 0;
};

} // namespace

TEST_CASE("a run that goes on has the light of one that took all steps at once") {
    Monitor monitor;
    Counting watcher, again;
    const Run whole = solve(furnace(), by("hemisphere", 4), monitor, watcher);
    CHECK(watcher.steps == 4);
    CHECK(whole.completed);
    Run parts = solve(furnace(), by("hemisphere", 2), monitor, again);
    REQUIRE(parts.steps.size() == 2);
    go_on(parts, stop_rule(by("hemisphere", 4), parts.mesh().patches().size()), again);
    CHECK(parts.steps.size() == 4);
    CHECK(parts.solution().radiosity == whole.solution().radiosity);
    CHECK(parts.steps.back().rays == whole.steps.back().rays);
    CHECK(parts.steps.back().seconds <= parts.seconds);
    CHECK(parts.before.seconds == parts.steps.back().seconds);
}

TEST_CASE("a run ends where its watcher finds it useful") {
    Monitor monitor;
    Counting watcher;
    watcher.useful_at = 3;
    CHECK(solve(furnace(), by("hemisphere", 8), monitor, watcher).steps.size() == 3);
}

TEST_CASE("time that went before counts for all records of a run") {
    Monitor monitor;
    Counting watcher;
    Run run = solve(furnace(), by("hemisphere", 2), monitor, watcher);
    const double first = run.steps.front().seconds;
    run.add_time_before(10);
    CHECK(run.steps.front().seconds == first + 10);
    CHECK(run.before.seconds >= 10);
}

TEST_CASE("a run ends by what was asked for, by its aim, or by its method's own rule") {
    constexpr std::size_t patches = 1000;
    RunChoices choices{.method = find_method("stored-transport")};
    CHECK(stop_rule(choices, patches).error == choices.method->default_stop.error);
    CHECK(stop_rule(choices, patches).rays == default_max_rays(patches));
    choices.sampling = .25;
    CHECK(stop_rule(choices, patches).error == .25);
    choices.stop.error = .5; // of something else than patches' means
    CHECK(stop_rule(choices, patches).error == .25);
    choices.stop = {};
    choices.stop.steps = 7;
    CHECK(stop_rule(choices, patches).steps == 7);
    CHECK_FALSE(stop_rule(choices, patches).error);
    choices.stop = {};
    choices.sampling.reset();
    choices.until_useful = true;
    CHECK_FALSE(stop_rule(choices, patches).error);
    CHECK_FALSE(stop_rule(choices, patches).steps);
}

TEST_CASE("a solver may fill half of a limit of memory, and its share of what is left") {
    const std::uint64_t usual = memory_of_solver({});
    CHECK(usual > 1'000'000'000);
    CHECK(memory_of_solver({.limit = 1000, .needed = 0, .solvers = 1}) == 501);
    CHECK(memory_of_solver({.limit = 1000, .needed = 800, .solvers = 2}) == 101);
    CHECK(memory_of_solver({.limit = 1000, .needed = 2000, .solvers = 1}) == 2);
}

TEST_CASE("runs side by side use up their budgets together") {
    Monitor monitor;
    const auto problem = furnace();
    const double step = 64 * double(problem->mesh->patches().size());
    const Budget budget = Budget{.rays = 4 * step, .seconds = {}, .error = {}}.with_end(step);
    std::vector<BudgetedRun> runs;
    for (const char* const method : {"hemisphere", "monte-carlo"})
        runs.emplace_back(problem, *find_method(method), SolveOptions{.threads = 1}, budget,
                          monitor);
    std::vector<std::size_t> order;
    go_on_side_by_side(runs, monitor, [&](std::size_t run) { order.push_back(run); });
    for (const BudgetedRun& run : runs) {
        CHECK(run.is_done());
        CHECK(run.share() == 1);
        CHECK(double(run.run().steps.back().rays) >= 3 * step);
        CHECK(run.run().steps.size() + 1 >= order.size() / 2);
    }
    CHECK(Budget{}.with_end(step).rays == Budget::default_steps * step);
}
