// States that no solver has saved: bytes and numbers changed at many places, as a checkpoint with a
// right checksum may hold them. Each is refused, or the run goes on to finite numbers.

#include "radiosity/engine/linear/energy_ledger.h"
#include "radiosity/engine/saving/state.h"
#include "radiosity/engine/solving/own_options.h"
#include "radiosity/paper/solution/solve_error.h"
#include "support/catch.h"
#include "support/guides.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <random>

using namespace hemilux;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::array<double, 12> odd_numbers{std::nan(""), infinity, -infinity, -1,   -0.0,   0,
                                             1e300,        -1e300,   1e-300,    1e18, 5e-324, 1e9};

constexpr int mutations = 300;

/// One change: a bit, a byte, or a whole field as a number or a count.
std::string changed(std::string bytes, std::mt19937& random) {
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
    const std::size_t at = below(bytes.size());
    const auto put = [&](std::uint64_t word) {
        const std::size_t begin = at / 4 * 4; // fields begin at multiples of 4
        for (std::size_t i = 0; i < 8 && begin + i < bytes.size(); ++i)
            bytes[begin + i] = static_cast<char>(word >> (8 * i) & 0xff);
    };
    switch (below(4)) {
    case 0:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
    case 1:
        bytes[at] = static_cast<char>(random());
        break;
    case 2:
        put(std::bit_cast<std::uint64_t>(odd_numbers[below(odd_numbers.size())]));
        break;
    default:
        put(below(2) == 0 ? ~std::uint64_t{0} >> below(64) : below(1000));
    }
    return bytes;
}

bool is_finite(const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// What may come of it; anything else fails the test.
struct Outcomes {
    int refused = 0, refused_later = 0, finite = 0;
};

void try_state(const Method& method, const SolverInput& input, const std::string& state,
               Outcomes& outcomes) {
    const auto solver = method.make(input);
    try {
        StateReader reader(state);
        solver->load(reader);
        reader.expect_end();
    } catch (const StateError& error) {
        CHECK(std::string(error.what()).size() > 5);
        ++outcomes.refused;
        return;
    }
    try {
        if (!solver->finished())
            (void)solver->step();
        ++outcomes.finite;
    } catch (const SolveError&) {
        ++outcomes.refused_later;
    }
    for (const Vec3& radiosity : solver->solution().radiosity)
        CHECK(is_finite(radiosity));
    if (solver->solution().steps > 1)
        for (const Vec3& error : solver->solution().standard_error)
            CHECK(is_finite(error));
}

} // namespace

TEST_CASE("changed states are refused, or go on to finite numbers", "[slow][state]") {
    const test::Model model(test::open_scene());
    for (const Method* const method : methods()) {
        if (!method->can_resume())
            continue;
        for (const Guide* const guide : test::all_guides()) {
            if (guide && (guide->name != "learned" || method->name != "hemisphere"))
                continue;
            SolveOptions options;
            options.rays = 2;
            options.threads = 1;
            set_own_options(options, GuideChoice{.guide = guide});
            Monitor monitor;
            const SolverInput input{model.mesh, model.bvh, options, monitor};
            StateWriter saved;
            {
                const auto solver = method->make(input);
                run(*solver, input, test::steps(3));
                solver->save(saved);
            }
            std::mt19937 random(5);
            Outcomes outcomes;
            for (int i = 0; i < mutations; ++i) {
                const std::string state = changed(saved.bytes(), random);
                CAPTURE(method->name, i);
                try_state(*method, input, state, outcomes);
            }
            CAPTURE(method->name, outcomes.refused, outcomes.refused_later, outcomes.finite);
            CHECK(outcomes.refused > 30);
            CHECK(outcomes.finite > 0);
        }
    }
}

TEST_CASE("the search for a way out ends where no rays are added, and at its limit", "[state]") {
    const test::Model model(test::open_scene());
    SolveOptions options;
    Monitor monitor;
    const SolverInput input{model.mesh, model.bvh, options, monitor};
    SearchForWayOut search(input);
    CHECK_NOTHROW(search.go_on(100, true));
    CHECK_NOTHROW(search.go_on(200, true));
    CHECK_THROWS_AS(search.go_on(200, true), SolveError); // a plan that does not grow
    SearchForWayOut limited(input);
    CHECK_THROWS_AS(limited.go_on(100'000'000, true), SolveError);
    SearchForWayOut last(input);
    CHECK_THROWS_AS(last.go_on(100, false), SolveError);
}
