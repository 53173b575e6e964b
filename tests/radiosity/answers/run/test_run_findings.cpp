// What is said about how a run ended.
#include "radiosity/answers/run/run_findings.h"
#include "support/catch.h"

#include <cmath>
#include <limits>
#include <vector>

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
    const std::vector steps{step(1, 1000, unknown), step(2, 2000, .02), step(3, 3000, .009)};
    CHECK(run_findings(steps, {.stop = to_error(.01, 1'000'000), .error = .009}).empty());
}

TEST_CASE("An error that was not reached is said, and what lets the run go on") {
    const std::vector steps{step(1, 2'000'000, .5)};
    const RunEnd end{.stop = to_error(.01, 1'000'000), .error = .5};
    const Findings findings = run_findings(steps, end);
    REQUIRE(findings.size() == 1);
    CHECK(findings[0].kind == Finding::Kind::warning);
    CHECK_THAT(findings[0].text, Contains("before the error of 1 %") && !Contains("--"));
    CHECK_THAT(findings[0].with_advice(), Contains("; --max-rays"));
    RunEnd interrupted = end;
    interrupted.interrupted = true;
    CHECK(run_findings(steps, interrupted).empty()); // who interrupts a run knows
}

TEST_CASE("An estimate that jumps is said, by its largest jump") {
    std::vector<StepRecord> steps;
    for (const double error : {.9, .0074, 3.9, .04})
        steps.push_back(step(1, 1000, error));
    const Findings findings = run_findings(steps, {.stop = to_error(.05, 1'000'000), .error = .04});
    REQUIRE(findings.size() == 1);
    CHECK_THAT(findings[0].text, Contains("0.74 %") && Contains("390 %"));
}

TEST_CASE("An error that is not known is said to be unknown") {
    const RunEnd end{.stop = {.steps = 2, .seconds = {}, .error = {}}, .error = unknown};
    std::vector steps{step(1, 1000, unknown)};
    CHECK(run_findings(steps, end).empty()); // a single step tells none
    steps.push_back(step(2, 2000, unknown));
    const Findings findings = run_findings(steps, end);
    REQUIRE(findings.size() == 1);
    CHECK_THAT(findings[0].text, Contains("unknown") && Contains("no light"));
}
