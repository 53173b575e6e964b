#include "radiosity/answers/vertices/smooth.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/catch.h"
#include "support/scenes.h"

#include <cmath>
#include <numbers>

using namespace hemilux;
using namespace hemilux::test;

namespace {

const std::vector<Material> two_materials{{"a", Vec3(0.5), Vec3(0)}, {"b", Vec3(0.5), Vec3(0)}};

Vec3 linear(const Vec3& p) { return {1 + p.x, 2 + 0.5 * p.z, 3 + p.x - 2 * p.z}; }

/// Two facets that meet along the y axis at an angle [degrees], the first in the plane z = 0.
Mesh fold(double degrees, std::uint32_t second_material) {
    const double a = degrees * std::numbers::pi / 180;
    Scene scene;
    scene.materials = two_materials;
    scene.groups = {"all"};
    add_quad(scene, {-1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {-1, 1, 0}, 1, 1, 0);
    const Vec3 far(std::cos(a), 0, std::sin(a));
    add_quad(scene, {0, 0, 0}, far, far + Vec3(0, 1, 0), {0, 1, 0}, 1, 1, second_material);
    return Mesh(std::move(scene));
}

} // namespace

TEST_CASE("weights reproduce every point of a triangle or a convex quad") {
    const std::vector<Polygon> shapes{
        {{Vec3(0, 0, 0), Vec3(3, 0, 1), Vec3(1, 2, 0), Vec3(1, 2, 0)}},
        {{Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(2, 0, 5), Vec3(0, 0, 5)}},
        {{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(1, 1, 0), Vec3(0, 3, 0)}},
        {{Vec3(0, 0, 1), Vec3(1e-3, 0, 1), Vec3(1, 1, 1), Vec3(0, 1e-3, 1)}},
        {{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(0, 1, 0)}}}; // three on a line
    Rng rng(3);
    for (const Polygon& shape : shapes)
        for (int i = 0; i < 200; ++i) {
            const Vec3 point = shape.sample({rng.uniform(), rng.uniform()});
            const auto weights = corner_weights(shape, point);
            Vec3 sum(0.0);
            for (std::size_t c = 0; c < 4; ++c) {
                REQUIRE(weights[c] >= 0);
                sum += weights[c] * shape.corner[c];
            }
            REQUIRE(glm::distance(sum, point) < 1e-9);
            REQUIRE(std::abs(weights[0] + weights[1] + weights[2] + weights[3] - 1) < 1e-12);
        }
}

TEST_CASE("a polygon without area has weights all the same") {
    const Vec3 p(1, 2, 3);
    for (const double w : corner_weights({{p, p, p, p}}, p))
        CHECK(std::isfinite(w));
}

TEST_CASE("inside a wall the corners of a linear radiosity are exact, and walls do not mix") {
    const Mesh mesh(box_room({0, 0, 0}, {3, 2, 1}, 6, two_materials, {0, 0, 0, 0, 0, 0}));
    std::vector<Vec3> b;
    for (const Patch& patch : mesh.patches())
        b.push_back(patch.normal.y > 0.5 ? linear(patch.centre) : Vec3(1000));
    const CornerClasses classes = find_corner_classes(mesh);
    CHECK(classes.position.size() == 6 * 7 * 7);
    const std::vector<Vec3> value = smooth(mesh, classes, b);
    int inner = 0;
    for (std::size_t i = 0; i < mesh.patches().size(); ++i)
        for (std::size_t c = 0; c < 4; ++c) {
            const std::uint32_t k = classes.of_patch[i][c];
            REQUIRE(classes.position[k] == mesh.patches()[i].shape.corner[c]);
            if (mesh.patches()[i].normal.y < 0.5) {
                REQUIRE(glm::distance(value[k], Vec3(1000)) < 1e-9);
                continue;
            }
            const Vec3 p = mesh.frame().to_world(classes.position[k]);
            if (!(p.x > 0.1 && p.x < 2.9 && p.z > 0.1 && p.z < 0.9))
                continue;
            ++inner;
            REQUIRE(glm::distance(value[k], linear(classes.position[k])) < 1e-9);
        }
    CHECK(inner == 4 * 5 * 5);
}

TEST_CASE("shading passes a soft fold, not a crease and not another material") {
    const auto classes = [](double degrees, std::uint32_t material) {
        return find_corner_classes(fold(degrees, material)).position.size();
    };
    CHECK(classes(0, 0) == 6);
    CHECK(classes(20, 0) == 6);
    CHECK(classes(30, 0) == 6);
    CHECK(classes(45, 0) == 8);
    CHECK(classes(90, 0) == 8);
    CHECK(classes(0, 1) == 8);
}

TEST_CASE("the two sides of a sheet are shaded apart") {
    Scene scene;
    scene.materials = two_materials;
    scene.groups = {"all"};
    add_quad(scene, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 3, 3, 0);
    const Mesh mesh(std::move(scene), {.two_sided = true});
    std::vector<Vec3> b;
    for (const Patch& patch : mesh.patches())
        b.push_back(Vec3(patch.back ? 5.0 : 1.0));
    const CornerClasses classes = find_corner_classes(mesh);
    CHECK(classes.position.size() == 2 * 16);
    const std::vector<Vec3> value = smooth(mesh, classes, b);
    for (std::size_t i = 0; i < b.size(); ++i)
        for (const std::uint32_t k : classes.of_patch[i])
            CHECK(value[k].x == Approx(b[i].x));
}

TEST_CASE("a finely divided sphere is one smooth surface") {
    const Mesh mesh(sphere(3, 1, 0.5, 0));
    const std::size_t triangles = mesh.patches().size();
    CHECK(find_corner_classes(mesh).position.size() == triangles / 2 + 2); // Euler
}

TEST_CASE("the apex of a cone of many facets takes no quadratic time") {
    constexpr std::uint32_t n = 100'000;
    Scene scene;
    scene.materials = two_materials;
    scene.groups = {"all"};
    scene.vertices.push_back({0, 0, 0.2});
    for (std::uint32_t i = 0; i < n; ++i) {
        const double a = 2 * std::numbers::pi * i / n;
        scene.vertices.push_back({std::cos(a), std::sin(a), 0});
        const std::uint32_t next = (i + 1) % n + 1;
        scene.facets.push_back({{0, i + 1, next, next}, i, 0, 0});
    }
    CHECK(find_corner_classes(Mesh(std::move(scene))).position.size() == n + 1);
}
