#include "radiosity/answers/vertices/baked_light.h"
#include "radiosity/light/cached_light/patch_light.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/catch.h"
#include "support/scenes.h"

using namespace hemilux;
using namespace hemilux::test;

TEST_CASE("baked irradiance is what a surface reflects over its reflectance") {
    const Vec3 rho(0.5, 0.25, 0), emission(3, 0, 1), arriving(2, 4, 8);
    const Mesh mesh(
        box_room({0, 0, 0}, {1, 2, 3}, 2, {{"wall", rho, emission}}, {0, 0, 0, 0, 0, 0}));
    const CornerClasses classes = find_corner_classes(mesh);
    const std::vector<Vec3> radiosity(mesh.patches().size(), emission + rho * arriving);
    for (const Vec3& light : baked_light(mesh, classes, PatchLight(radiosity), Bake::irradiance)) {
        CHECK(light.r == Approx(2));
        CHECK(light.g == Approx(4));
        CHECK(light.b == 0); // not known
    }
    for (const Vec3& light : baked_light(mesh, classes, PatchLight(radiosity), Bake::radiosity))
        CHECK(light.r == Approx(4));
}

TEST_CASE("the exposure of a mesh counts surfaces by their areas, without the sky") {
    Scene scene =
        box_room({0, 0, 0}, {1, 1, 10}, 1, // four long sides, two small ends
                 {{"side", Vec3(0.5), Vec3(0)}, {"end", Vec3(0.5), Vec3(0)}}, {0, 0, 0, 0, 1, 1});
    const auto exposure = [&] {
        const Mesh mesh(scene);
        const CornerClasses classes = find_corner_classes(mesh);
        std::vector<Vec3> light;
        for (const Patch& patch : mesh.patches())
            light.push_back(Vec3(patch.material == 0 ? 0.4 : 0.1));
        return auto_exposure(mesh, classes,
                             baked_light(mesh, classes, PatchLight(light), Bake::radiosity));
    };
    CHECK(exposure() == Approx(0.8 / 0.4));
    scene.materials[0].is_far = true;
    CHECK(exposure() == Approx(0.8 / 0.1));
}
