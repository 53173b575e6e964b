#include "radiosity/answers/views/up_axis.h"

#include "radiosity/light/lamps/emitter_shapes.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/catch.h"
#include "support/lit_scenes.h"
#include "support/scenes.h"

#include <cmath>

using namespace hemilux;
using namespace hemilux::test;

namespace {

/// A bottle of n sides, from the origin upwards.
Scene bottle(std::uint32_t n) {
    Scene scene;
    scene.materials = {{"glass", Vec3(0.5), Vec3(0)}};
    scene.groups = {"bottle"};
    const auto at = [&](std::uint32_t k, double r, double y) {
        const double turn = 6.283185307179586 * (k % n) / n;
        return Vec3(r * std::cos(turn), y, r * std::sin(turn));
    };
    for (std::uint32_t k = 0; k < n; ++k) {
        add_quad(scene, at(k + 1, 0.04, 0), at(k, 0.04, 0), at(k, 0.04, 0.2), at(k + 1, 0.04, 0.2),
                 1, 1, 0);
        add_quad(scene, at(k + 1, 0.04, 0.2), at(k, 0.04, 0.2), at(k, 0.015, 0.3),
                 at(k + 1, 0.015, 0.3), 1, 1, 0);
        add_quad(scene, at(k, 0.04, 0), at(k + 1, 0.04, 0), at(k + 1, 0.001, 0), at(k, 0.001, 0), 1,
                 1, 0);
    }
    return scene;
}

Scene terrain() {
    Scene scene;
    scene.materials = {{"grass", Vec3(0.5), Vec3(0)}};
    scene.groups = {"land"};
    const auto at = [](int x, int z) {
        return Vec3(x, 0.4 * std::sin(1.3 * x) * std::cos(0.9 * z + 0.4), z);
    };
    for (int x = 0; x < 10; ++x)
        for (int z = 0; z < 10; ++z) {
            const Vec3 a = at(x, z), b = at(x, z + 1), c = at(x + 1, z + 1), d = at(x + 1, z);
            add_quad(scene, a, b, c, c, 1, 1, 0);
            add_quad(scene, a, c, d, d, 1, 1, 0);
        }
    return scene;
}

} // namespace

TEST_CASE("The axis upwards is guessed of rooms, things and land, whichever it is") {
    for (Scene& scene :
         std::vector<Scene>{room_with_block(), pavilion(0), pavilion(3), standing_thing(),
                            bottle(12), bottle(40), terrain(), open_scene()}) {
        INFO(scene.groups[0] << ", " << scene.facets.size() << " facets");
        CHECK(guess_up(Mesh(turned_to_z(scene))) == 2);
        CHECK(guess_up(Mesh(std::move(scene))) == 1);
    }
}

TEST_CASE("The sun and names of floors say what is upwards of a cube") {
    Scene cube;
    cube.materials = {{"a", Vec3(0.5), Vec3(0)}, {"Floor tiles", Vec3(0.5), Vec3(0)}};
    cube.groups = {"cube"};
    add_cube(cube, Vec3(0.0), 1);
    CHECK(guess_up(Mesh(cube)) == 1);
    for (const int up : {1, 2}) {
        Scene sunny = cube;
        Vec3 way(0.1, 0, 0);
        way[up] = -1;
        add_sun(sunny, "sun", bounds_of(sunny), way, Vec3(1));
        add_sun(sunny, "another", bounds_of(sunny), way, Vec3(1));
        Scene named = cube;
        for (Facet& facet : named.facets) {
            const auto normal_of = [&](int k) { return named.vertices[facet.vertex[k]]; };
            const Vec3 n = glm::cross(normal_of(1) - normal_of(0), normal_of(2) - normal_of(0));
            if (std::abs(n[up]) > 0.5)
                facet.material = 1;
        }
        CHECK(guess_up(Mesh(named)) == up);
        if (up == 1)
            CHECK(guess_up_axis(Mesh(sunny)).for_z < -0.5);
        else
            CHECK(guess_up_axis(Mesh(sunny)).for_z > 0.5);
    }
}

TEST_CASE("A name counts for a floor by a word in it, not by letters within a word") {
    for (const char* const name : {"Background", "waterproof"}) {
        Scene cube;
        cube.materials = {{"a", Vec3(0.5), Vec3(0)}, {name, Vec3(0.5), Vec3(0)}};
        cube.groups = {"cube"};
        add_cube(cube, Vec3(0.0), 1);
        cube.facets.back().material = 1; // looks along z
        CHECK(guess_up_axis(Mesh(cube)).for_z == 0);
        cube.materials[1].name = "the ground";
        CHECK(guess_up_axis(Mesh(cube)).for_z > 1);
    }
}

TEST_CASE("What is usual in files of a kind decides where little speaks against it") {
    Scene cube;
    cube.materials = {{"a", Vec3(0.5), Vec3(0)}};
    cube.groups = {"cube"};
    add_cube(cube, Vec3(0.0), 1);
    CHECK(guess_up(Mesh(cube), 2) == 2);
    CHECK(guess_up(Mesh(cube), 1) == 1);
    CHECK(guess_up(Mesh(pavilion(0)), 2) == 1);
    CHECK(guess_up(Mesh(turned_to_z(pavilion(0))), 1) == 2);
}
