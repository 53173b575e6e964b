// What the program says about how a run ended.
#include "app/running/run_notes.h"
#include "app/terminal/summary.h"
#include "support/catch.h"

#include <cmath>
#include <limits>

using namespace hemilux;
using Catch::Contains;

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

StopRule to_error(double error, std::uint64_t rays) {
    return {.steps = {}, .seconds = {}, .error = error, .rays = rays};
}

StepRecord step(std::uint32_t number, std::uint64_t rays, double error) {
    return {number, rays, 0.0, error};
}

} // namespace

TEST_CASE("A run that reached its error has nothing to be said") {
    RunNotes notes(to_error(.01, 1'000'000));
    notes.step_done(step(1, 1000, unknown));
    notes.step_done(step(2, 2000, .02));
    notes.step_done(step(3, 3000, .009));
    CHECK(notes.texts(.009, false).empty());
}

TEST_CASE("An error that was not reached is said, and what lets the run go on") {
    RunNotes notes(to_error(.01, 1'000'000));
    notes.step_done(step(1, 2'000'000, .5));
    const auto texts = notes.texts(.5, false);
    REQUIRE(texts.size() == 1);
    CHECK_THAT(texts[0], Contains("before the error of 1 %") && Contains("--max-rays"));
    CHECK(notes.texts(.5, true).empty()); // who interrupts a run knows
}

TEST_CASE("An estimate that jumps is said, by its largest jump") {
    RunNotes notes(to_error(.05, 1'000'000));
    for (const double error : {.9, .0074, 3.9, .04})
        notes.step_done(step(1, 1000, error));
    const auto texts = notes.texts(.04, false);
    REQUIRE(texts.size() == 1);
    CHECK_THAT(texts[0], Contains("0.74 %") && Contains("390 %"));
}

TEST_CASE("An error that is not known is said to be unknown") {
    RunNotes notes(StopRule{.steps = 2, .seconds = {}, .error = {}});
    notes.step_done(step(1, 1000, unknown));
    CHECK(notes.texts(unknown, false).empty()); // a single step tells none
    notes.step_done(step(2, 2000, unknown));
    const auto texts = notes.texts(unknown, false);
    REQUIRE(texts.size() == 1);
    CHECK_THAT(texts[0], Contains("unknown") && Contains("no light"));
}

TEST_CASE("Where the error of the division was not measured, that of sampling is still said") {
    Statistics run;
    run.steps = 2;
    run.estimated_error = run.error_division = unknown;
    run.error_sampling = .0191;
    CHECK_THAT(run_text(run), Contains("estimated error unknown: the run ended before that of the "
                                       "division was measured; sampling 1.91 %"));
    run.error_sampling = unknown;
    CHECK_THAT(run_text(run), Contains("estimated error unknown") && !Contains("sampling"));
}
