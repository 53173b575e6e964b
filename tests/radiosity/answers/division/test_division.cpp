// A division returns the problem of the patches that it made, and the run on them.
#include "radiosity/answers/division/whole_error.h"
#include "support/catch.h"
#include "support/scenes.h"

#include <cmath>
#include <memory>
#include <string>
#include <vector>

using namespace hemilux;
using Catch::Contains;

namespace {

struct Listening : Watcher {
    void take(const Finding& finding) override { findings.push_back(finding); }
    Findings findings;
};

Problem cube() {
    Watcher nobody;
    return prepare(std::make_shared<Mesh>(test::cube_with_lit_floor(1, .5)), {}, {.threads = 1},
                   nobody);
}

RunChoices by(const char* method, double error) {
    RunChoices choices{.method = find_method(method), .sampling = share_of_sampling * error};
    choices.options.threads = 1;
    return choices;
}

} // namespace

TEST_CASE("a division makes a problem of more patches and begins the run on them", "[slow]") {
    constexpr double error = .05;
    Monitor monitor;
    Listening listening;
    const Method* const standard = find_method("stored-transport");
    Divided divided = divide(cube(), by("stored-transport", error),
                             {.error = error, .standard = standard}, monitor, listening);
    const std::size_t patches = divided.problem->mesh->patches().size();
    CHECK(patches > 6);
    REQUIRE(divided.linear);
    CHECK(divided.slope.size() == patches);
    REQUIRE(divided.run);
    CHECK(divided.run->problem == divided.problem);
    CHECK(divided.run->solution().radiosity.size() == patches);
    CHECK(divided.steps == divided.run->steps.size());
    CHECK(divided.work.rays > 0);
    CHECK(divided.work.rays_error > 0);
    REQUIRE_FALSE(listening.findings.empty());
    CHECK(listening.findings[0].kind == Finding::Kind::detail);
    CHECK_THAT(listening.findings[0].text, Contains("division: 6 patches"));

    Solution solution = divided.run->solution();
    solution.slope = divided.slope;
    WholeError whole = error_of_sampling(*divided.problem->mesh, solution);
    find_error_of_division(whole, divided, solution, {.is_asked_for = true, .threads = 1},
                           monitor.interrupted);
    CHECK(whole.rays == 0); // which the division has found out
    CHECK(whole.error() <= error);
    CHECK_FALSE(whole_error_finding(error, whole, "--memory"));
    CHECK_THAT(whole_error_finding(error / 10, whole, "--memory").value().text,
               Contains("before the whole error of 0.5 % was reached"));
}

TEST_CASE("another method gets the patches, and no run of the method that divides") {
    constexpr double error = .2;
    Monitor monitor;
    Watcher nobody;
    const Divided divided =
        divide(cube(), by("hemisphere", error),
               {.error = error, .standard = find_method("stored-transport")}, monitor, nobody);
    CHECK_FALSE(divided.run);
    CHECK(divided.steps == 0);
    CHECK_FALSE(divided.error);
    CHECK(divided.rough.radiosity.size() == divided.problem->mesh->patches().size());
    CHECK(divided.work.rays > 0);
}
