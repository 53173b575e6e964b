#include "bvh/wide/wide_bvh.h"
#include "radiosity/answers/vertices/indirect_light.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/catch.h"
#include "support/scenes.h"

using namespace hemilux;
using namespace hemilux::test;

TEST_CASE("in a furnace the indirect irradiance is what walls reflect") {
    const Vec3 rho(0.5, 0.25, 0), emission(3, 0, 1);
    const Mesh mesh(
        box_room({0, 0, 0}, {1, 2, 3}, 2, {{"wall", rho, emission}}, {0, 0, 0, 0, 0, 0}));
    const WideBvh bvh(mesh.soup());
    const std::vector<Vec3> radiosity(mesh.patches().size(), emission / (1.0 - rho));
    for (const Vec3& light : indirect_irradiance(mesh, bvh, radiosity, 40, 1, Workers(2))) {
        CHECK(light.r == Approx(3)); // B - E on all sides, whatever the rays
        CHECK(light.g == Approx(0).margin(1e-12));
        CHECK(light.b == Approx(0).margin(1e-12));
    }
}

TEST_CASE("indirect irradiance between two squares follows their form factor") {
    Scene scene;
    scene.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                      {0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}};
    scene.facets = {{{0, 1, 2, 3}, 0, 0, 0}, {{4, 5, 6, 7}, 1, 1, 0}};
    scene.materials = {{"floor", Vec3(0.5), Vec3(0.0)}, {"lamp", Vec3(0.4), Vec3(1.0)}};
    scene.groups = {"all"};
    scene.faces = 2;
    const Mesh mesh(std::move(scene));
    const WideBvh bvh(mesh.soup());
    const double f = 0.19982490; // Howell C-11
    const std::vector<Vec3> radiosity{Vec3(0.1), Vec3(1.25)};
    const unsigned rays = 1'000'000;
    const auto light = indirect_irradiance(mesh, bvh, radiosity, rays, 7, Workers(1));
    const double deviation = std::sqrt(f * (1 - f) / rays); // of the share of rays that hit
    CHECK(light[0].r == Approx(0.25 * f).margin(4 * 0.25 * deviation));
    CHECK(light[1].r == Approx(0.1 * f).margin(4 * 0.1 * deviation));
    CHECK((indirect_irradiance(mesh, bvh, radiosity, 999, 7, Workers(1)) ==
           indirect_irradiance(mesh, bvh, radiosity, 999, 7, Workers(3))));
}
