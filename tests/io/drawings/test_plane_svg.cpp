// The subdivision in a plane: what it cuts of a scene, and what is drawn.
#include "io/drawings/plane_svg.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/catch.h"
#include "support/scenes.h"

#include <algorithm>

using namespace hemilux;
using Catch::Contains;

namespace {

/// A room of 2 x 2 x 2 m, undivided; the floor is the first patch.
Mesh cube() {
    return Mesh(test::box_room({0, 0, 0}, {2, 2, 2}, 1, {{"white", Vec3(.5), Vec3(0.0)}},
                               {0, 0, 0, 0, 0, 0}));
}

} // namespace

TEST_CASE("A plane across the floor of a cube cuts floor, ceiling and two walls") {
    const Mesh mesh = cube();
    const Patch& floor = mesh.patches()[0];
    const auto sections = cut_by_plane(mesh, 0, floor.centre);
    REQUIRE(sections.size() == 4);
    CHECK(std::ranges::count_if(sections, &PlaneSection::own) == 1);
    const double height = 2 * mesh.frame().scale;
    for (const PlaneSection& section : sections) {
        const Vec2 low = glm::min(section.end[0], section.end[1]);
        const Vec2 high = glm::max(section.end[0], section.end[1]);
        CHECK(low.y > -1e-9);
        CHECK(high.y < height + 1e-9);
        if (section.own)
            CHECK(high.y < 1e-9);
        else // the ceiling, or a wall over all its height
            CHECK((low.y > height - 1e-9 || high.y - low.y > height - 1e-9));
    }
}

TEST_CASE("Behind a patch nothing is cut") {
    Scene scene = test::box_room({0, 0, 0}, {2, 2, 2}, 1, {{"white", Vec3(.5), Vec3(0.0)}},
                                 {0, 0, 0, 0, 0, 0});
    test::add_cube(scene, {1, -1, 1}, .4);
    const Mesh mesh(scene);
    CHECK(cut_by_plane(mesh, 0, mesh.patches()[0].centre).size() == 4);
}

TEST_CASE("The drawing of a plane has the rays that lie in it, with what they count") {
    const Mesh mesh = cube();
    const PlaneDrawing drawing{"a title",
                               {{{0, 0, 1}, 7}, {{1, 0, 0}, 8}, {{0, 1, 0}, 9}},
                               cut_by_plane(mesh, 0, mesh.patches()[0].centre)};
    const std::string svg = plane_svg(drawing);
    CHECK_THAT(svg, Contains("a title") && Contains(">7<") && Contains(">8<") && !Contains(">9<"));
}
