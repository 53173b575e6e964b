// A mesh whose patches were divided differently is written without T-junctions.
#include "io/meshes/ply.h"
#include "io/meshes/vtu.h"
#include "radiosity/answers/charts/charts.h"
#include "radiosity/answers/vertices/baked_light.h"
#include "radiosity/answers/vertices/convex_triangles.h"
#include "radiosity/engine/cells/refine.h"
#include "radiosity/light/cached_light/patch_light.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

using namespace hemilux;
using namespace hemilux::test;
using Catch::Contains;

namespace {

const std::vector<Material> grey{{"grey", Vec3(0.5), Vec3(0)}};

/// Some patches twice, some of their pieces twice again.
void refine_at_random(Mesh& mesh, std::uint64_t seed) {
    Rng rng(seed);
    for (int round = 0; round < 2; ++round) {
        std::vector<std::uint8_t> levels;
        for (std::size_t i = 0; i < mesh.patches().size(); ++i)
            levels.push_back(rng.uniform() < 0.3 ? 2 : 0);
        refine(mesh, levels);
    }
}

using Place = std::array<double, 3>;
Place place_of(const Vec3& p) {
    Place place{};
    for (int axis = 0; axis < 3; ++axis) // equal but for rounding
        place.at(static_cast<std::size_t>(axis)) = std::round(p[axis] * 1e7) + 0.0;
    return place;
}

/// How often the triangles run along each of their sides, by where its ends are; the same side run
/// the other way round counts too.
std::map<std::set<Place>, int> sides_of(const Mesh& mesh, const CornerClasses& classes) {
    std::map<std::set<Place>, int> sides;
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i)
        for_each_triangle(classes, i, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
                ++sides[{place_of(classes.position[from]), place_of(classes.position[to])}];
        });
    return sides;
}

/// Sides that not exactly two triangles have.
long unmatched(const Mesh& mesh) {
    const auto sides = sides_of(mesh, find_corner_classes(mesh));
    return std::ranges::count_if(sides, [](const auto& side) { return side.second != 2; });
}

double area_of_triangles(const Mesh& mesh, const CornerClasses& classes, std::uint32_t patch) {
    double area = 0;
    for_each_triangle(classes, patch, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const Vec3 at = classes.position[a];
        const double part =
            glm::dot(glm::cross(classes.position[b] - at, classes.position[c] - at) / 2.0,
                     mesh.patches()[patch].normal);
        CHECK(part > 1e-9);
        area += part;
    });
    return area;
}

} // namespace

TEST_CASE("each side in a closed divided mesh is that of two triangles") {
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        Mesh box(box_room({0, 0, 0}, {1, 2, 5}, 2, grey, {}));
        refine_at_random(box, seed);
        CHECK(unmatched(box) == 0);
        Mesh ball(sphere(1, 1, 0.5, 0));
        refine_at_random(ball, seed);
        CHECK(unmatched(ball) == 0);
        CHECK(!find_corner_classes(ball).outlines.empty());
    }
}

TEST_CASE("facets that cut their common edge into other numbers of pieces share its points") {
    Scene scene; // a closed tetrahedron of unequal edges, with narrow triangles
    scene.materials = grey;
    scene.groups = {"all"};
    scene.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 5, 0}, {0, 0, 0.3}};
    std::uint32_t face = 0;
    for (const auto& [a, b, c] :
         std::vector<std::array<std::uint32_t, 3>>{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}})
        scene.facets.push_back({{a, b, c, c}, face++, 0, 0});
    scene.faces = face;
    for (const double max_edge : {0.25, 0.37}) {
        Mesh mesh(scene, {.max_edge = max_edge});
        CHECK(unmatched(mesh) == 0);
        refine_at_random(mesh, 7);
        CHECK(unmatched(mesh) == 0);
    }
}

TEST_CASE("the triangles of a divided mesh cover each patch") {
    Mesh mesh(box_room({0, 0, 0}, {1, 2, 5}, 1, grey, {}));
    refine_at_random(mesh, 5);
    const CornerClasses classes = find_corner_classes(mesh);
    REQUIRE(!classes.outlines.empty());
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i)
        CHECK(area_of_triangles(mesh, classes, i) == Approx(mesh.patches()[i].area));
}

TEST_CASE("light passes on from a coarse patch to its finer neighbours, not over a crease") {
    Mesh mesh(box_room({0, 0, 0}, {1, 1, 1}, 2, grey, {}));
    std::vector<std::uint8_t> levels(mesh.patches().size(), 0);
    levels[0] = 1; // of the floor
    refine(mesh, levels);
    std::vector<Vec3> light;
    for (const Patch& patch : mesh.patches())
        light.push_back(Vec3(patch.normal.y > 0.5 ? 1 + patch.centre.x : 100.0));
    const CornerClasses classes = find_corner_classes(mesh);
    const std::vector<Vec3> value = baked_light(mesh, classes, PatchLight(light), Bake::radiosity);
    std::size_t shared = 0, apart = 0;
    for (const Outline& outline : classes.outlines) {
        const bool floor = mesh.patches()[outline.patch].normal.y > 0.5;
        REQUIRE(outline.classes.size() == 5);
        for (const std::uint32_t k : outline.classes) {
            CHECK((value[k].x < 10) == floor);
            if (k < classes.position.size() - classes.between.size())
                shared += floor;
            else
                apart += !floor;
        }
    }
    CHECK(shared == 2 * 5); // two patches of the floor
    CHECK(apart == 2);      // one each of two walls
    CHECK(classes.between.size() == 2);
}

TEST_CASE("a point on a coarse patch's side has the mean of all around it, but not in pictures") {
    Scene scene;
    scene.materials = grey;
    scene.groups = {"all"};
    add_quad(scene, {0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}, 2, 1, 0);
    Mesh mesh(std::move(scene));
    refine(mesh, std::vector<std::uint8_t>{0, 1});
    std::vector<Vec3> light(mesh.patches().size(), Vec3(3));
    light[0] = Vec3(1);
    const CornerClasses classes = find_corner_classes(mesh);
    REQUIRE(classes.outlines.size() == 1);
    const Outline& outline = classes.outlines[0];
    CHECK(outline.patch == 0);
    REQUIRE(outline.classes.size() == 5);
    const std::uint32_t between = outline.classes[2]; // of corners 1 and 2
    CHECK(smooth(mesh, classes, light)[between].x == Approx(2));
    CHECK(smooth(mesh, classes, light, {}, MeanOver::corners)[between].x == Approx(3));
}

TEST_CASE("a lightmap's classes have the triangles of the mesh") {
    Mesh mesh(box_room({0, 0, 0}, {1, 2, 3}, 2, grey, {}));
    refine_at_random(mesh, 3);
    const CornerClasses classes = find_corner_classes(mesh);
    const ChartCorners corners = divide_by_charts(mesh, classes, find_charts(mesh, 256));
    CHECK(sides_of(mesh, corners.classes) == sides_of(mesh, classes));
}

TEST_CASE("files of a divided mesh have the vertices on its sides") {
    Mesh mesh(box_room({0, 0, 0}, {1, 2, 3}, 1, grey, {}));
    refine_at_random(mesh, 9);
    const CornerClasses classes = find_corner_classes(mesh);
    std::size_t triangles = 0, ring = 0;
    for (const Outline& outline : classes.outlines) {
        CHECK(outline.triangles.size() == outline.classes.size() - 2);
        triangles += outline.triangles.size();
        ring += outline.classes.size();
    }
    const std::size_t quads = mesh.patches().size() - classes.outlines.size();
    Solution solution;
    solution.radiosity.assign(mesh.patches().size(), Vec3(1));
    const TemporaryFolder folder;
    write_ply(folder.path("a.ply"), mesh, classes,
              {baked_light(mesh, classes, solution, Bake::radiosity)});
    const std::string ply = content_of(folder.path("a.ply"));
    CHECK_THAT(ply, Contains("element face " + std::to_string(quads + triangles) + "\n"));
    const std::size_t vertex = 3 * sizeof(double) + 3 * sizeof(float), index = 4;
    CHECK(ply.size() == ply.find("end_header\n") + 11 + classes.position.size() * vertex +
                            quads * (1 + 4 * index) + triangles * (1 + 3 * index));
    write_vtu(folder.path("a.vtu"), mesh, classes, solution);
    const std::string vtu = content_of(folder.path("a.vtu"));
    CHECK_THAT(vtu, Contains("NumberOfCells=\"" + std::to_string(mesh.patches().size()) + "\""));
    const std::string offset =
        "Name=\"offsets\" NumberOfComponents=\"1\" format=\"appended\" offset=\"";
    const std::string of_corners =
        "Name=\"connectivity\" NumberOfComponents=\"1\" format=\"appended\" offset=\"";
    const auto number_after = [&](const std::string& text) {
        return std::stoul(vtu.substr(vtu.find(text) + text.size()));
    };
    CHECK(number_after(offset) - number_after(of_corners) == 8 + index * (4 * quads + ring));
}

TEST_CASE("triangles of a convex polygon with corners within its sides") {
    const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0},
                                    {3, 1, 0}, {3, 2, 0}, {0, 2, 0}, {0, 1, 0}};
    const auto triangles = convex_triangles(corners);
    CHECK(triangles.size() == corners.size() - 2);
    double area = 0;
    for (const auto& [a, b, c] : triangles) {
        const double part = glm::cross(corners[b] - corners[a], corners[c] - corners[a]).z / 2;
        CHECK(part > 0.1);
        area += part;
    }
    CHECK(area == Approx(6));
}
