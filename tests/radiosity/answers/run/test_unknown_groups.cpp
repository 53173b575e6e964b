// A warning names the groups whose light a run does not know.
#include "radiosity/answers/run/unknown_groups.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solution/solution.h"
#include "support/catch.h"
#include "support/scenes.h"

#include <utility>

using Catch::Contains;
using namespace hemilux;

TEST_CASE("groups are named whose error is more than a quarter of their light") {
    Scene scene = test::furnace_box(1, .5);
    scene.groups = {"walls", "attic", "cellar"};
    for (std::uint32_t f = 0; f < scene.facets.size(); ++f)
        scene.facets[f].group = f % 3;
    const Mesh mesh(std::move(scene));
    Solution solution;
    solution.steps = 2;
    solution.radiosity.assign(mesh.patches().size(), Vec3(2.0)); // 1 of it reflected
    solution.standard_error.assign(mesh.patches().size(), Vec3(.01));
    CHECK_FALSE(unknown_groups_finding(mesh, solution));
    const auto set = [&](std::uint32_t group, double reflected, double sigma) {
        for (std::uint32_t i = 0; i < mesh.patches().size(); ++i)
            if (mesh.scene().facets[mesh.patches()[i].facet].group == group) {
                solution.radiosity[i] = Vec3(1 + reflected);
                solution.standard_error[i] = Vec3(sigma);
            }
    };
    set(1, .04, .02);
    CHECK_THAT(unknown_groups_finding(mesh, solution).value().with_advice(),
               Contains("light of attic is not known") && Contains("--for group:attic"));
    set(2, 0, .001); // none was found, but there may be some
    CHECK_THAT(unknown_groups_finding(mesh, solution).value().text, Contains("attic, cellar"));
    set(2, 0, 0); // none can be there
    CHECK_THAT(unknown_groups_finding(mesh, solution).value().text, !Contains("cellar"));
    solution.steps = 1;
    CHECK_FALSE(unknown_groups_finding(mesh, solution));
}
