// A black picture with an error of 0 % does not pass for a result.
#include "radiosity/answers/run/lost_light.h"
#include "radiosity/answers/run/run.h"
#include "support/catch.h"
#include "support/scenes.h"

#include <memory>

using namespace hemilux;
using Catch::Contains;

namespace {

/// A lamp that looks up, at the back of a wall close above it, and a floor below.
Scene lamp_at_a_wall(double reflectance) {
    Scene scene;
    scene.groups = {"all"};
    scene.materials = {{"lamp", Vec3(0), Vec3(1)}, {"grey", Vec3(reflectance), Vec3(0)}};
    const auto add = [&](double z, std::uint32_t material) {
        test::add_quad(scene, {0, 0, z}, {1, 0, z}, {1, 1, z}, {0, 1, z}, 1, 1, material);
    };
    add(1, 0);
    add(1.01, 1);
    add(0, 1);
    return scene;
}

std::optional<Finding> finding_of(Scene scene) {
    Monitor monitor;
    RunWatcher nobody;
    RunChoices choices{.method = find_method("stored-transport")};
    choices.options.threads = 1;
    choices.stop.steps = 2;
    const Run run =
        solve(std::make_shared<const Problem>(
                  prepare(std::make_shared<Mesh>(std::move(scene)), {}, {.threads = 1}, nobody)),
              choices, monitor, nobody);
    return lost_light_finding(run.mesh(), *run.problem->tracer, run.solution(), Sides::front);
}

} // namespace

TEST_CASE("a lamp whose light falls on a back is warned of, and what lights the scene is named") {
    const std::optional<Finding> found = finding_of(lamp_at_a_wall(.5));
    REQUIRE(found);
    CHECK(found->kind == Finding::Kind::warning);
    CHECK_THAT(found->text, Contains("nothing is lit: ") && Contains("fell on backs of faces"));
    CHECK_THAT(found->advice, Contains("--sides auto"));
    CHECK_THAT(finding_of(lamp_at_a_wall(0)).value().text, Contains("all reflectances are 0"));
}

TEST_CASE("a room whose light stays in it has nothing to be said of it") {
    CHECK_FALSE(finding_of(test::cube_with_lit_floor(1, .5)));
}
