// Division of facets into patches, and the way back from a hit to its patch.
#include "radiosity/paper/scene/mesh.h"

#include "bvh/bvh.h"
#include "radiosity/paper/sampling/rng.h"
#include "support/catch.h"
#include "support/scenes.h"

#include <stdexcept>

using namespace hemilux;

namespace {

/// A trapezoid, a general convex quad, an equilateral triangle and a sliver, in the plane y = 0,
/// facing up.
Scene odd_facets() {
    Scene scene;
    scene.materials = {{"grey", Vec3(.5), Vec3(0.0)}};
    scene.groups = {"default"};
    scene.vertices = {{0, 0, 0},  {.5, 0, 2},  {1.5, 0, 2},   {3, 0, 0},  // trapezoid
                      {4, 0, 0},  {4.2, 0, 3}, {6, 0, 2},     {7, 0, -1}, // general
                      {10, 0, 0}, {9, 0, 1.7}, {11, 0, 1.7},              // triangle
                      {12, 0, 0}, {13, 0, 4},  {13.001, 0, 4}};           // sliver
    scene.facets = {{{0, 1, 2, 3}, 0, 0, 0},
                    {{4, 5, 6, 7}, 1, 0, 0},
                    {{8, 9, 10, 10}, 2, 0, 0},
                    {{11, 12, 13, 13}, 3, 0, 0}};
    scene.faces = 4;
    return scene;
}

/// Signed distance to the nearest edge, positive inside.
double inside(const Polygon& polygon, const Vec3& p, const Vec3& normal) {
    double nearest = 1e300;
    for (int i = 0; i < polygon.size(); ++i) {
        const Vec3 a = polygon.corner[std::size_t(i)];
        const Vec3 b = polygon.corner[std::size_t((i + 1) % polygon.size())];
        nearest =
            std::min(nearest, glm::dot(glm::cross(normal, b - a), p - a) / glm::length(b - a));
    }
    return nearest;
}

} // namespace

TEST_CASE("Divided facets keep their area and obey the edge length") {
    const Scene scene = odd_facets();
    const Mesh whole(scene);
    for (const double max_edge : {10.0, 1.0, .37, .1}) {
        const Mesh mesh(scene, {.max_edge = max_edge});
        std::vector<double> area(4);
        for (const Patch& patch : mesh.patches()) {
            area[patch.facet] += patch.area;
            CHECK(patch.normal.y == Approx(1));
            CHECK(patch.area > 0);
            for (int i = 0; i < patch.shape.size(); ++i) {
                const auto& corner = patch.shape.corner;
                const Vec3 edge =
                    corner[std::size_t((i + 1) % patch.shape.size())] - corner[std::size_t(i)];
                CHECK(glm::length(edge) / mesh.frame().scale <= max_edge * (1 + 1e-6));
            }
        }
        for (std::size_t f = 0; f < 4; ++f)
            CHECK(area[f] == Approx(whole.patches()[f].area).epsilon(1e-12));
    }
}

TEST_CASE("A hit is found in the patch that holds it") {
    for (const bool two_sided : {false, true}) {
        const Mesh mesh(odd_facets(), {.max_edge = .21, .two_sided = two_sided});
        const Bvh bvh(mesh.soup());
        Rng rng(3);
        for (const Patch& target : mesh.patches()) {
            const double u = rng.uniform(), v = rng.uniform();
            const Vec3 point = target.shape.sample({u, v});
            Vec3 offset(rng.uniform() - .5, 1, rng.uniform() - .5);
            if (target.back)
                offset.y = -1;
            const auto hit = bvh.closest({point + offset, -offset});
            REQUIRE(hit);
            const std::uint32_t found = mesh.patch_at(*hit);
            REQUIRE(found != none);
            const Patch& patch = mesh.patches()[found];
            CHECK(patch.facet == target.facet);
            CHECK(patch.back == target.back);
            CHECK(inside(patch.shape, point, patch.normal) > -1e-12);
        }
    }
}

TEST_CASE("Backs: a patch of their own, or none") {
    const Mesh one(odd_facets()), two(odd_facets(), {.two_sided = true});
    const Hit below{.facet = 1, .t = 1, .u = .2, .v = .3, .second_half = false, .front = false};
    CHECK(one.patch_at(below) == none);
    const std::uint32_t back = two.patch_at(below);
    CHECK(back == 3); // front first
    CHECK(two.patches()[back].back);
    CHECK(two.patches()[back].normal.y == Approx(-1));
    CHECK(two.patches()[back].area == two.patches()[back - 1].area);
    CHECK(two.patches().size() == 2 * one.patches().size());
}

TEST_CASE("The local frame loses nothing") {
    Scene scene = odd_facets();
    for (Vec3& v : scene.vertices)
        v = 1e-9 * v + Vec3(1e-3, 0, 5);
    const Mesh mesh(scene);
    CHECK(mesh.frame().to_world(mesh.vertices()[6]).x ==
          Approx(scene.vertices[6].x).epsilon(1e-15));
    for (const Vec3& v : mesh.vertices())
        CHECK(std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) <= 1);
    CHECK(mesh.frame().area_to_world(mesh.patches()[0].area) == Approx(4e-18).epsilon(1e-6));
}

TEST_CASE("Meshes that cannot be made") {
    CHECK_THROWS_AS(Mesh(Scene{}), std::invalid_argument);
    CHECK_THROWS_AS(Mesh(odd_facets(), {.max_edge = 1e-9}), std::invalid_argument);
    CHECK_THROWS_AS(Mesh(odd_facets(), {.max_edge = .01, .max_patches = 1000}),
                    std::invalid_argument);
    CHECK_NOTHROW(Mesh(odd_facets(), {.max_patches = 4}));
    // Both sides of a face are patches.
    const std::size_t patches = Mesh(odd_facets(), {.max_edge = .1}).patches().size();
    CHECK_THROWS_AS(Mesh(odd_facets(), {.max_edge = .1, .two_sided = true, .max_patches = patches}),
                    std::invalid_argument);
}
