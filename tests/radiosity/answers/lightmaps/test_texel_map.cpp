// What texels of a lightmap show, which of them are covered, and the light that they get.
#include "parallel/workers.h"
#include "radiosity/answers/charts/charts.h"
#include "radiosity/answers/lightmaps/covered_texels.h"
#include "radiosity/answers/lightmaps/lightmap_gather.h"
#include "radiosity/answers/lightmaps/lightmap_target.h"
#include "radiosity/engine/rays/point_emitter.h"
#include "radiosity/light/final_gather/light_at_points.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <algorithm>
#include <cmath>

using namespace hemilux;
using namespace hemilux::test;

namespace {

/// A floor of 4 x 4 m, one chart of it, and a block that stands on it.
struct BlockOnFloor {
    Model model;
    TexelMap texels;

    explicit BlockOnFloor(int size)
        : model(scene()), texels(model.mesh, placed(model.mesh, size), size) {}

    static Scene scene() {
        Scene scene;
        scene.groups = {"floor"};
        scene.materials = {{"a", Vec3(.5), Vec3(0)}, {"lamp", Vec3(0), Vec3(10)}};
        add_quad(scene, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}, 1, 1, 0);
        add_quad(scene, {-1, 4, -1}, {1, 4, -1}, {1, 4, 1}, {-1, 4, 1}, 1, 1, 1);
        add_block(scene, {-.5, 0, -.5}, {.5, 1, .5});
        return scene;
    }
    /// The floor over the whole square.
    static std::vector<PlacedTriangle> placed(const Mesh& mesh, int size) {
        std::vector<PlacedTriangle> triangles;
        for (const bool second : {false, true}) {
            PlacedTriangle triangle{0, false, second, 0, {}};
            const auto corners = corners_of(mesh, triangle);
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3 at = mesh.frame().to_world(corners[k]);
                triangle.place[k] = double(size) * Vec2((at.x + 2) / 4, (at.z + 2) / 4);
            }
            triangles.push_back(triangle);
        }
        return triangles;
    }
};

} // namespace

TEST_CASE("light does not cross a wall that is thinner than a texel") {
    Scene scene;
    scene.groups = {"floor"};
    scene.materials = {
        {"white", Vec3(.8), Vec3(0)}, {"lamp", Vec3(0), Vec3(10)}, {"black", Vec3(0), Vec3(0)}};
    add_quad(scene, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}, 1, 1, 0);
    add_quad(scene, {1, 1, -.1}, {1.2, 1, -.1}, {1.2, 1, .1}, {1, 1, .1}, 1, 1, 1);
    add_quad(scene, {1.9, 0, -2}, {1.9, 0, 2}, {1.9, 1.5, 2}, {1.9, 1.5, -2}, 1, 1, 0);
    for (const double side : {-1., 1.}) // low enough that no light comes over it
        add_quad(scene, {.02, 0, -2 * side}, {.02, 2, -2 * side}, {.02, 2, 2 * side},
                 {.02, 0, 2 * side}, 1, 1, 2);
    const Model model(std::move(scene));
    constexpr int size = 32;
    const TexelMap texels(model.mesh, BlockOnFloor::placed(model.mesh, size), size);
    const Solution solution = solve(model, *find_method("stored-transport"), {}, steps(2));
    const SurfaceLight light(model.mesh, PatchLight(solution));
    const GatheredLightmap lightmap =
        gather_texels(model.mesh, model.bvh, light, texels, std::vector<bool>(texels.count()),
                      {.bake = Bake::irradiance, .rays = 16}, Workers(2));
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size / 2; ++x)
            CHECK(lightmap.image.at(x, y).x <= .005 * lightmap.image.at(size / 2 + 1, y).x);
        CHECK(lightmap.image.at(size / 2 + 1, y).x > 0);
    }
}

TEST_CASE("a texel shows a point at its middle, and the nearest one beside a chart") {
    constexpr double aside = .02; // of the middle, so that none lies in the plane of a surface
    const Mesh mesh(box_room({0, 0, 0}, {3, 2, 5}, 2, {{"a", Vec3(0.5), Vec3(1)}}, {}));
    constexpr int size = 128;
    const std::vector<LightmapChart> charts = find_charts(mesh, size);
    const TexelMap texels(mesh, placed_triangles(mesh, charts), size);
    CHECK(texels.overlaps().empty());
    std::size_t inside = 0, beside = 0;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const std::size_t texel = texels.index(x, y);
            if (!texels.shows(texel))
                continue;
            const SurfacePoint point = texels.point(texel);
            const LightmapChart& chart = charts[texels.triangle(texel).chart];
            const double gap = glm::distance(chart.place(point.position), Vec2(x + .5, y + .5));
            CHECK(gap == Approx(texels.distance(texel)).margin(aside));
            CHECK(mesh.patches()[point.patch].facet == point.facet);
            CHECK(point.normal == mesh.patches()[point.patch].normal);
            ++(texels.is_inside(texel) ? inside : beside);
            CHECK(gap <= TexelMap::reach + aside);
        }
    CHECK(inside > 10'000);
    CHECK(beside > 500);
}

TEST_CASE("middles of texels in the plane of a lamp have its light as the points beside them") {
    // A lamp cuts a wall at a height at which a row of texels has its middles.
    Scene scene;
    scene.vertices = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0},
                      {0, 1, 0}, {0, 1, 1}, {2, 1, 1}, {2, 1, 0}};
    scene.materials = {{.name = "wall"}, {.name = "lamp", .emission = Vec3(1)}};
    scene.groups = {"all"};
    scene.facets = {{{0, 1, 2, 3}, 0, 0, 0}, {{4, 7, 6, 5}, 1, 1, 0}};
    scene.faces = 2;
    const Mesh mesh(scene);
    std::vector<PlacedTriangle> triangles;
    for (const bool second : {false, true})
        triangles.push_back({0, false, second, 0,
                             second ? std::array<Vec2, 3>{Vec2(.5, .5), {20.5, 20.5}, {.5, 20.5}}
                                    : std::array<Vec2, 3>{Vec2(.5, .5), {20.5, .5}, {20.5, 20.5}}});
    const TexelMap texels(mesh, triangles, 22);
    int above = 0, below = 0;
    for (int x = 1; x < 20; ++x) {
        const double height = mesh.frame().to_world(texels.point(texels.index(x, 10)).position).y;
        above += height > 1 + 1e-4;
        below += height < 1 - 1e-4;
    }
    CHECK(above + below == 19); // not in the plane
    CHECK((above == 0 || below == 0));
}

TEST_CASE("overlaps of texture coordinates are found by objects") {
    Scene scene = BlockOnFloor::scene();
    scene.groups = {"floor", "block"};
    for (std::size_t f = 2; f < scene.facets.size(); ++f)
        scene.facets[f].group = 1;
    const Mesh mesh(scene);
    constexpr int size = 32;
    std::vector<PlacedTriangle> triangles = BlockOnFloor::placed(mesh, size);
    CHECK(TexelMap(mesh, triangles, size).overlaps().empty());
    triangles.push_back({2, false, false, 1, {Vec2(4, 4), {12, 4}, {12, 12}}});
    const TexelMap texels(mesh, triangles, size);
    REQUIRE(texels.overlaps().size() == 1);
    CHECK(texels.overlaps()[0].texels > 20);
    CHECK(texels.overlaps()[0].texels < 40);
    CHECK(texels.overlaps()[0].facet == 0);
    CHECK(texels.overlaps()[0].other == 2);
}

TEST_CASE("texels below a block are covered, those around it are not") {
    constexpr int size = 96;
    const BlockOnFloor floor(size);
    const std::vector<bool> covered = find_covered(
        floor.model.mesh, floor.model.bvh, floor.texels, [] {}, Workers(2));
    std::size_t wrong = 0, below = 0;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const Vec2 at(4 * (x + .5) / size - 2, 4 * (y + .5) / size - 2);
            const bool is_below = std::max(std::abs(at.x), std::abs(at.y)) < .5;
            below += is_below;
            wrong += covered[floor.texels.index(x, y)] != is_below;
        }
    CHECK(below == 576);
    CHECK(wrong == 0);
}

TEST_CASE("texels have the light of their points, also where a block stands on them") {
    constexpr int size = 64;
    const BlockOnFloor floor(size);
    const Mesh& mesh = floor.model.mesh;
    const Workers workers(0);
    std::vector<Vec3> sent;
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i)
        sent.push_back(mesh.material(i).emission);
    const SurfaceLight light(mesh, PatchLight(sent));
    const std::vector<bool> covered = find_covered(
        mesh, floor.model.bvh, floor.texels, [] {}, workers);
    GatheredLightmap lightmap = gather_texels(mesh, floor.model.bvh, light, floor.texels, covered,
                                              {.bake = Bake::irradiance, .rays = 64}, workers);
    fill_texels(lightmap, floor.texels, 2);

    std::vector<Sensor> sensors;
    std::vector<std::size_t> which;
    for (std::size_t texel = 5; texel < floor.texels.count(); texel += 41)
        if (!covered[texel]) {
            SurfacePoint at = floor.texels.point(texel);
            at.patch = none;
            sensors.push_back({at, none});
            which.push_back(texel);
        }
    const LightAtPoints truth =
        light_at(sensors, mesh, floor.model.bvh, light, {.rays = 4096}, workers);
    double squares = 0, all = 0;
    for (std::size_t k = 0; k < which.size(); ++k) {
        const double off = lightmap.image.pixels[which[k]].x - truth.lights[k].irradiance.x;
        squares += off * off;
        all += truth.lights[k].irradiance.x * truth.lights[k].irradiance.x;
    }
    CHECK(std::sqrt(squares / all) < .03);
    CHECK(
        judge_of_lightmaps(mesh, floor.model.bvh, light, floor.texels, covered, Bake::irradiance, 3)
            .error_of(lightmap.image, 512, workers)
            .error < .03);

    // Under the block there is the light that is beside it, and no darkness.
    const glm::vec3 under = lightmap.image.at(size / 2, size / 2),
                    beside = lightmap.image.at(14, 32);
    CHECK(under.x > .3f * beside.x);

    SECTION("what sends is that by the reflectance, and only what is reflected by itself is dark") {
        const GatheredLightmap radiosity =
            gather_texels(mesh, floor.model.bvh, light, floor.texels, covered,
                          {.bake = Bake::radiosity, .rays = 64}, workers);
        const GatheredLightmap indirect =
            gather_texels(mesh, floor.model.bvh, light, floor.texels, covered,
                          {.bake = Bake::indirect, .rays = 64}, workers);
        CHECK(radiosity.image.at(5, 5).x == Approx(.5f * lightmap.image.at(5, 5).x));
        // Patches reflect nothing in this light; paths find what the near block does.
        CHECK(indirect.image.at(5, 5).x < .02f * lightmap.image.at(5, 5).x);
    }
}

TEST_CASE("texels have the light of lights without extent, unless only what is reflected counts") {
    constexpr int size = 32;
    Scene scene;
    scene.groups = {"floor"};
    scene.materials = {{"a", Vec3(.5), Vec3(0)}};
    add_quad(scene, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}, 1, 1, 0);
    const Vec3 lamp(.5, 1.5, -.25);
    add_point_emitter(scene, {.name = "lamp", .position = lamp, .intensity = Vec3(10, 5, 2)});
    const Model model(scene);
    const TexelMap texels(model.mesh, BlockOnFloor::placed(model.mesh, size), size);
    const std::vector<Vec3> dark(model.mesh.patches().size(), Vec3(0.0));
    const SurfaceLight light(model.mesh, PatchLight(dark));
    const std::vector<bool> covered(texels.count());
    const Workers workers(2);
    const GatheredLightmap lightmap = gather_texels(model.mesh, model.bvh, light, texels, covered,
                                                    {.bake = Bake::irradiance}, workers);
    for (std::size_t texel = 0; texel < texels.count(); ++texel) {
        const Vec3 way = lamp - model.mesh.frame().to_world(texels.point(texel).position);
        const double distance = glm::length(way);
        REQUIRE(lightmap.image.pixels[texel].x ==
                Approx(10 * way.y / std::pow(distance, 3)).epsilon(1e-3));
    }
    CHECK(judge_of_lightmaps(model.mesh, model.bvh, light, texels, covered, Bake::irradiance, 3)
              .error_of(lightmap.image, 256, workers)
              .error < 1e-3);
    const GatheredLightmap indirect = gather_texels(model.mesh, model.bvh, light, texels, covered,
                                                    {.bake = Bake::indirect}, workers);
    CHECK(indirect.image.at(9, 9) == glm::vec3(0));
}

TEST_CASE("the error of a lightmap is known where one texel in four hundred has all of it") {
    constexpr int size = 128;
    Scene scene;
    scene.groups = {"floor"};
    scene.materials = {{"a", Vec3(.5), Vec3(0)}};
    add_quad(scene, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}, 1, 1, 0);
    add_point_emitter(scene, {.name = "lamp", .position = {.5, 1.5, -.25}, .intensity = Vec3(10)});
    const Model model(scene);
    std::vector<PlacedTriangle> placed = BlockOnFloor::placed(model.mesh, size);
    for (PlacedTriangle& triangle : placed)
        for (Vec2& place : triangle.place)
            place = place * (size - 4.) / double(size) + 2.;
    const TexelMap texels(model.mesh, std::move(placed), size);
    const std::vector<Vec3> dark(model.mesh.patches().size(), Vec3(0.0));
    const SurfaceLight light(model.mesh, PatchLight(dark));
    const std::vector<bool> covered(texels.count());
    const Workers workers(2);
    GatheredLightmap lightmap = gather_texels(model.mesh, model.bvh, light, texels, covered,
                                              {.bake = Bake::irradiance}, workers);
    double all = 0, off = 0;
    const auto spoil = [&](std::size_t texel) {
        off += std::pow(lightmap.image.pixels[texel].x, 2);
        lightmap.image.pixels[texel] *= 2;
    };
    for (const glm::vec3& texel : lightmap.image.pixels)
        all += texel.x * texel.x;
    SECTION("somewhere") {
        for (std::size_t k = 400; k < texels.count(); k += 401)
            if (texels.is_inside(k))
                spoil(k);
    }
    SECTION("beside the triangles") {
        for (std::size_t k = 0; k < texels.count(); k += 11)
            if (texels.shows(k) && !texels.is_inside(k))
                spoil(k);
    }
    double mean = 0;
    constexpr std::uint64_t seeds = 8;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const PictureError found = judge_of_lightmaps(model.mesh, model.bvh, light, texels, covered,
                                                      Bake::irradiance, seed)
                                       .error_of(lightmap.image, 512, workers);
        CHECK(std::pow(found.error, 2) == Approx(off / all).epsilon(.4));
        CHECK(found.error + 3 * found.uncertainty > std::sqrt(off / all));
        mean += found.error * found.error / seeds;
    }
    CHECK(mean == Approx(off / all).epsilon(.15));
}

TEST_CASE("in a room of one radiosity texels at the edges of walls have all the light") {
    constexpr int size = 64;
    const Model model(box_room({0, 0, 0}, {3, 2, 2}, 1, {{"a", Vec3(0), Vec3(1)}}, {}));
    const TexelMap texels(model.mesh, placed_triangles(model.mesh, find_charts(model.mesh, size)),
                          size);
    const std::vector<Vec3> sent(model.mesh.patches().size(), Vec3(1.0));
    const SurfaceLight light(model.mesh, PatchLight(sent));
    const GatheredLightmap lightmap =
        gather_texels(model.mesh, model.bvh, light, texels, std::vector<bool>(texels.count()),
                      {.bake = Bake::irradiance, .rays = 64}, Workers(2));
    std::size_t edges = 0;
    for (std::size_t k = 0; k < texels.count(); ++k) {
        if (!texels.shows(k))
            continue;
        edges += !texels.is_inside(k);
        REQUIRE(lightmap.image.pixels[k].x == Approx(1).margin(.01));
    }
    CHECK(edges > 300);
}

TEST_CASE("gutters and covered texels take the light beside them") {
    constexpr int size = 16;
    const BlockOnFloor floor(size);
    std::vector<PlacedTriangle> triangles = BlockOnFloor::placed(floor.model.mesh, size);
    for (PlacedTriangle& triangle : triangles)
        for (Vec2& place : triangle.place)
            place = .25 * place + Vec2(6); // of 4 x 4 texels
    const TexelMap texels(floor.model.mesh, triangles, size);
    GatheredLightmap lightmap(texels);
    for (std::size_t k = 0; k < texels.count(); ++k)
        if ((lightmap.known[k] = texels.shows(k) && k != texels.index(7, 7)))
            lightmap.image.pixels[k] = glm::vec3(2);
    fill_texels(lightmap, texels, 2);
    CHECK(lightmap.image.at(7, 7) == glm::vec3(2));
    CHECK(lightmap.image.at(3, 8) == glm::vec3(2));
    CHECK(lightmap.image.at(0, 8) == glm::vec3(0));
}
