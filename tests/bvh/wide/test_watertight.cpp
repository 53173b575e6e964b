// No ray leaks between neighbours, and none is counted twice: closed meshes, seen from inside.
#include "bvh/wide/wide_bvh.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/catch.h"
#include "support/scenes.h"

#include <numbers>

using namespace hemilux;

namespace {

Vec3 uniform_direction(Rng& rng) {
    const double z = 2 * rng.uniform() - 1, phi = 2 * std::numbers::pi * rng.uniform();
    const double r = safe_sqrt(1 - z * z);
    return {r * std::cos(phi), r * std::sin(phi), z};
}

/// Unit box, each side of 2 x n slivers 1/n wide.
Scene sliver_box(std::uint32_t n) {
    Scene scene = test::box_room(Vec3(0.0), Vec3(1.0), 1, {{"wall", Vec3(.5), Vec3(1.0)}},
                                 {0, 0, 0, 0, 0, 0});
    Scene slivers;
    slivers.materials = scene.materials;
    slivers.groups = scene.groups;
    for (const Facet& facet : scene.facets) {
        // Strips from edge 0-1 to edge 3-2, cut into triangles; neighbours share their vertices.
        const auto base = static_cast<std::uint32_t>(slivers.vertices.size());
        for (std::uint32_t i = 0; i <= n; ++i) {
            const double s = double(i) / n;
            const auto between = [&](std::size_t a, std::size_t b) {
                return (1 - s) * scene.vertices[facet.vertex[a]] +
                       s * scene.vertices[facet.vertex[b]];
            };
            slivers.vertices.push_back(between(0, 1));
            slivers.vertices.push_back(between(3, 2));
        }
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t p = base + 2 * i;
            slivers.facets.push_back({{p, p + 2, p + 3, p + 3}, slivers.faces++, 0, 0});
            slivers.facets.push_back({{p, p + 3, p + 1, p + 1}, slivers.faces++, 0, 0});
        }
    }
    return slivers;
}

/// Rays from random points of random patches into their hemispheres: how many find nothing.
std::size_t escapes(Scene scene, const Vec3& shift, std::size_t rays) {
    for (Vec3& v : scene.vertices)
        v += shift;
    const Mesh mesh(std::move(scene));
    const WideBvh bvh(mesh.soup());
    Rng rng(7);
    std::size_t escaped = 0;
    for (std::size_t k = 0; k < rays; ++k) {
        const auto i = static_cast<std::size_t>(rng.uniform() * double(mesh.patches().size()));
        const Patch& patch = mesh.patches()[i];
        const double u = rng.uniform(), v = rng.uniform();
        Vec3 direction = uniform_direction(rng);
        if (glm::dot(direction, patch.normal) < 0)
            direction = -direction;
        Ray ray{patch.shape.sample({u, v}), direction};
        ray.from = patch.facet;
        escaped += !bvh.closest(ray);
    }
    return escaped;
}

constexpr std::size_t many = 1'000'000;

} // namespace

TEST_CASE("No ray escapes from a closed sphere", "[slow]") {
    const Scene scene = test::sphere(5, 1, .5, 1);
    CHECK(scene.facets.size() == 8192);
    CHECK(escapes(scene, Vec3(0.0), many) == 0);
    CHECK(escapes(scene, Vec3(1e6, -1e6, 1e6), many) == 0);
}

TEST_CASE("No ray escapes from a closed box of slivers", "[slow]") {
    // Triangles of length 1 and width 1e-5, 200 000 a side; fewer would not be as thin.
    const Scene scene = sliver_box(100'000);
    CHECK(escapes(scene, Vec3(0.0), many) == 0);
    CHECK(escapes(scene, Vec3(-1e6, 1e6, 1e6), many) == 0);
}

TEST_CASE("No ray escapes from small closed meshes") {
    CHECK(escapes(test::sphere(2, 3, .5, 1), Vec3(0.0), 50'000) == 0);
    CHECK(escapes(sliver_box(50), Vec3(1e6), 50'000) == 0);
    CHECK(escapes(test::furnace_l_shape(.5), Vec3(0.0), 50'000) == 0);
}

TEST_CASE("Rays exactly through vertices and edges pierce one facet") {
    const Mesh mesh(test::box_room(Vec3(-1.0), Vec3(1.0), 4, {{"wall", Vec3(.5), Vec3(0.0)}},
                                   {0, 0, 0, 0, 0, 0}));
    const WideBvh bvh(mesh.soup());
    // All vertices of the grid of a side, edge midpoints and quad diagonals, along the axis and
    // obliquely.
    for (int i = -3; i <= 3; ++i)
        for (int j = -3; j <= 3; ++j) {
            const Vec3 on_wall(0.5, .125 * i,
                               .125 * j); // the scene fills [-.5,.5]^3 of the local frame
            for (const Vec3& origin :
                 {Vec3(0.0), Vec3(0, on_wall.y, on_wall.z), Vec3(-.25, 0, 0)}) {
                const Ray ray{origin, on_wall - origin};
                CAPTURE(i, j, origin.x, origin.y);
                CHECK(bvh.count(ray) == 1);
                const auto hit = bvh.closest(ray);
                REQUIRE(hit);
                CHECK(hit->t == Approx(1));
                CHECK(hit->front);
            }
        }
}

TEST_CASE("A line through a closed sphere enters and leaves once") {
    const Mesh mesh(test::sphere(3, 1, .5, 1));
    const WideBvh bvh(mesh.soup());
    const auto vertices = mesh.vertices();
    for (std::size_t a = 0; a < vertices.size(); a += 7) {
        const Vec3 outside = 3.0 * vertices[a] + Vec3(.01, -.02, .03);
        for (std::size_t b = 0; b < vertices.size(); b += 5) { // exactly at vertices
            const std::uint32_t count = bvh.count({outside, vertices[b] - outside});
            CAPTURE(a, b);
            CHECK((count == 0 || count == 2)); // 0: grazing a silhouette
        }
    }
}
