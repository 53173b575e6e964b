// The same bytes on any number of ranks, which are threads here: solutions, logs and states.
#include "parallel/workers.h"
#include "radiosity/engine/needs/find_needs.h"
#include "radiosity/engine/solving/shared_stop.h"
#include "support/catch.h"
#include "support/rank_threads.h"
#include "support/same_solution.h"
#include "support/scenes.h"
#include "support/solve.h"
#include "support/watched_tracer.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <tuple>

using namespace hemilux;
using test::Model;

namespace {

constexpr MeshOptions divided{.max_edge = .4};

/// What a rank ends with.
struct Found {
    Solution solution;
    std::vector<StepRecord> log;
    std::string state; ///< whole on the first rank
    RankWork work;
};

struct Run {
    const Model& model;
    const Method& method;
    SolveOptions options = {};
    StopRule stop = test::steps(3);
    std::string resumed = {}; ///< a state
    std::vector<double> target = {};
};

Found solve_on(const Ranks& ranks, const Run& asked) {
    Monitor monitor;
    const SharedStop shared(monitor.interrupted, ranks);
    const Needs needs = find_needs(asked.model.mesh);
    const SolverInput input{.mesh = asked.model.mesh,
                            .tracer = asked.model.bvh,
                            .options = asked.options,
                            .monitor = monitor,
                            .needs = needs,
                            .target = asked.target};
    const auto solver = asked.method.make(input);
    Before before;
    if (!asked.resumed.empty()) {
        StateReader reader(asked.resumed);
        solver->load(reader);
        before.steps = solver->solution().steps;
    }
    Found found;
    run(
        *solver, input, asked.stop,
        [&](const StepRecord& record, const Solution&) { found.log.push_back(record); }, before);
    found.solution = solver->solution();
    if (asked.method.can_resume()) {
        StateWriter state;
        solver->save(state);
        found.state = state.bytes();
    }
    found.work = ranks.work();
    return found;
}

std::vector<Found> on_ranks(unsigned count, const Run& asked, RankMemory memory = RankMemory::own) {
    std::vector<Found> found(count);
    run_as_ranks(
        count, [&](const Ranks& ranks) { found[ranks.index()] = solve_on(ranks, asked); }, memory);
    return found;
}

void check_same(const Solution& a, const Solution& b) {
    test::check_same_estimates(a, b);
    CHECK(a.figures.value("bytes_transport") == b.figures.value("bytes_transport"));
    // Where several threads solve a step its sums are added in another order.
    CHECK(glm::length(a.energy.absorbed - b.energy.absorbed) <=
          1e-14 * glm::length(b.energy.absorbed));
    CHECK(glm::length(a.energy.escaped - b.energy.escaped) <=
          1e-14 * glm::length(b.energy.escaped));
}

/// All ranks have found what one alone has.
void check_ranks(const std::vector<Found>& ranks, const Found& alone) {
    for (const Found& of_rank : ranks) {
        check_same(of_rank.solution, alone.solution);
        REQUIRE(of_rank.log.size() == alone.log.size());
        for (std::size_t k = 0; k < alone.log.size(); ++k) {
            CHECK(of_rank.log[k].rays == alone.log[k].rays);
            CHECK(of_rank.log[k].seconds == ranks[0].log[k].seconds);
            CHECK((of_rank.log[k].estimated_error == alone.log[k].estimated_error ||
                   std::isnan(alone.log[k].estimated_error)));
        }
    }
    CHECK(ranks[0].state.size() == alone.state.size());
}

/// Steps that can be worked out at the same time are, and those that may grow do.
const StopRule many_steps{.seconds = 1e9};

} // namespace

TEST_CASE("Methods that share their work find the same bytes on any number of ranks and threads",
          "[slow]") {
    const Model open(test::open_scene(), divided), room(test::room_with_block(), divided);
    REQUIRE(room.mesh.patches().size() > 5 * OwnBlocks::min_block);
    REQUIRE(open.mesh.patches().size() > 5 * OwnBlocks::min_block);
    for (const Model* model : {&open, &room})
        for (const Method* method : methods()) {
            if (!method->can_resume())
                continue;
            SolveOptions options{.rays = 8, .stop = many_steps, .threads = 1};
            const Found alone = solve_on(one_rank(), {*model, *method, options});
            for (const auto& [count, threads, memory] : {std::tuple{2u, 1u, RankMemory::shared},
                                                         {3u, 2u, RankMemory::own},
                                                         {3u, 2u, RankMemory::shared},
                                                         {5u, 1u, RankMemory::own}}) {
                CAPTURE(method->name, count, threads, memory);
                options.threads = threads;
                check_ranks(on_ranks(count, {*model, *method, options}, memory), alone);
            }
        }
}

TEST_CASE("Methods that each rank solves by itself find the same bytes") {
    const Model model(test::open_scene(), {.max_edge = .5});
    for (const Method* method : methods())
        if (!method->can_resume()) {
            CAPTURE(method->name);
            const Run asked{model, *method, {.rays = 4, .threads = 1}, test::steps(2)};
            check_ranks(on_ranks(2, asked), solve_on(one_rank(), asked));
        }
}

TEST_CASE("A run to an error ends at the same step on any number of ranks") {
    const Model model(test::room_with_block(), divided);
    for (const char* name : {"stored-transport", "hemisphere", "monte-carlo"}) {
        CAPTURE(name);
        const StopRule stop{.steps = {}, .seconds = {}, .error = .1};
        const Run asked{model, *find_method(name), {.rays = 16, .stop = stop, .threads = 1}, stop};
        const Found alone = solve_on(one_rank(), asked);
        CHECK(alone.solution.steps > 1);
        check_ranks(on_ranks(3, asked), alone);
    }
}

TEST_CASE("With a target, or where the memory forgets rays, ranks find the same bytes", "[slow]") {
    const Model model(test::room_with_block(), divided);
    Run asked{model, *find_method("stored-transport"), {.rays = 16, .threads = 1}};
    asked.target.assign(model.mesh.patches().size(), 0.0);
    for (std::size_t i = 0; i < 40; ++i)
        asked.target[i] = 1;
    check_ranks(on_ranks(3, asked), solve_on(one_rank(), asked));
    asked.target.clear();
    asked.options.memory = 400'000;
    asked.stop = test::steps(5);
    const Found alone = solve_on(one_rank(), asked);
    check_ranks(on_ranks(2, asked), alone);
}

TEST_CASE("A state of any number of ranks goes on at any other") {
    const Model model(test::room_with_block(), divided);
    for (const char* name : {"stored-transport", "stratified"}) {
        CAPTURE(name);
        const Method& method = *find_method(name);
        Run asked{model, method, {.rays = 16, .stop = many_steps, .threads = 1}, test::steps(4)};
        const Found whole = solve_on(one_rank(), asked);
        asked.stop = test::steps(2);
        const std::string state = on_ranks(3, asked)[0].state;
        if (method.name == std::string_view("stored-transport")) // others keep a time
            CHECK((state == solve_on(one_rank(), asked).state));
        asked.stop = test::steps(4);
        asked.resumed = state;
        for (const unsigned count : {1u, 2u, 5u})
            for (const Found& of_rank : on_ranks(count, asked))
                check_same(of_rank.solution, whole.solution);
    }
}

TEST_CASE("Ranks share the rays and the matrix evenly") {
    const Model model(test::room_with_block(), {.max_edge = .1});
    const Run asked{model, *find_method("stored-transport"), {.rays = 16, .threads = 1}};
    const RankWork all = solve_on(one_rank(), asked).work;
    const std::vector<Found> ranks = on_ranks(4, asked);
    std::uint64_t rays = 0, entries = 0, max_rays = 0, max_entries = 0, sent = 0, received = 0;
    for (const Found& of_rank : ranks) {
        rays += of_rank.work.rays;
        entries += of_rank.work.entries;
        max_rays = std::max(max_rays, of_rank.work.rays);
        max_entries = std::max(max_entries, of_rank.work.entries);
        sent += of_rank.work.sent;
        received += of_rank.work.received;
    }
    CHECK(rays == ranks[0].solution.rays_energy);
    CHECK(sent == received);
    CHECK(4 * max_rays < 5 * rays / 4);
    CHECK(4 * max_entries < 5 * entries / 4);
    CHECK(entries > 0);
    CHECK(all.sent == 0);
}

TEST_CASE("Where one rank is interrupted all end at the same step") {
    const Model model(test::room_with_block(), divided);
    for (const char* name : {"stored-transport", "stratified", "hierarchical", "matrix"}) {
        if (!find_method(name)) // of research
            continue;
        const Method& method = *find_method(name);
        const SolveOptions options{.rays = 16, .stop = many_steps, .threads = 1};
        for (const int streams : {5, 60, 130}) {
            CAPTURE(name, streams);
            std::vector<Solution> found(3);
            std::atomic<int> completed{0};
            run_as_ranks(3, [&](const Ranks& ranks) {
                Monitor monitor;
                const SharedStop shared(monitor.interrupted, ranks);
                const test::AfterStreams tracer(model.bvh, streams, [&] {
                    if (ranks.index() == 1)
                        monitor.interrupted.set_wished(true);
                });
                const SolverInput input{
                    .mesh = model.mesh, .tracer = tracer, .options = options, .monitor = monitor};
                const auto solver = method.make(input);
                completed += run(*solver, input, test::steps(40)) ? 1 : 0;
                found[ranks.index()] = solver->solution();
            });
            for (const Solution& of_rank : found)
                check_same(of_rank, found[0]);
            CHECK(completed == 0);
            const std::uint32_t steps = found[0].steps;
            CHECK(steps < 40);
            if (steps > 0 && method.name == std::string_view("stratified"))
                check_same(found[0], test::solve(model, method, options, test::steps(steps)));
        }
    }
}
