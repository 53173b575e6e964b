// The charts of a lightmap of our own: how surfaces are laid flat, and how densely they are packed.
#include "radiosity/answers/charts/charts.h"
#include "radiosity/answers/charts/flat_overlaps.h"
#include "radiosity/answers/charts/rectangle_packing.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/catch.h"
#include "support/scenes.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

using namespace hemilux;
using namespace hemilux::test;

namespace {

/// Charts of both sides where there are two, with their density.
double stretch_of(const Mesh& mesh, const LightmapChart& chart) {
    double most = 0;
    for (const ChartSide& side : chart.sides) {
        const Polygon shape = mesh.shape_of(side.facet);
        const Vec3 normal = side.back ? -shape.normal() : shape.normal();
        const Vec3 axis = glm::cross(chart.along, chart.across);
        most = std::max(most, 1 / std::abs(glm::dot(normal, axis)));
    }
    return most;
}

/// No two facets of a chart lie over each other in it.
bool is_flat(const Mesh& mesh, const LightmapChart& chart) {
    std::vector<LaidPolygon> flat;
    for (const ChartSide& side : chart.sides)
        flat.push_back(LaidPolygon::of(mesh.shape_of(side.facet), chart.along, chart.across));
    return !find_flat_overlap(flat);
}

/// A torus whose tube is thick, so that its inner half lies below the outer one from the side.
Scene torus(int rings, int segments) {
    Scene scene;
    scene.materials = {{"a", Vec3(.5), Vec3(1)}};
    scene.groups = {"torus"};
    const auto at = [&](int i, int k) {
        const double u = 2 * 3.14159265358979 * i / rings, v = 2 * 3.14159265358979 * k / segments;
        return Vec3((2 + std::cos(v)) * std::cos(u), (2 + std::cos(v)) * std::sin(u), std::sin(v));
    };
    for (int i = 0; i < rings; ++i)
        for (int k = 0; k < segments; ++k) {
            const auto first = static_cast<std::uint32_t>(scene.vertices.size());
            for (const auto& [di, dk] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}})
                scene.vertices.push_back(at((i + di) % rings, (k + dk) % segments));
            for (const std::uint32_t t : {first, first + 3})
                scene.facets.push_back({{t, t + 1, t + 2, t + 2}, scene.faces++, 0, 0});
        }
    return scene;
}

} // namespace

TEST_CASE("polygons lie over each other where they share more than a border") {
    const LaidPolygon square{{Vec2(0, 0), {1, 0}, {1, 1}, {0, 1}}};
    const auto moved = [&](double x, double y) {
        LaidPolygon polygon = square;
        for (Vec2& corner : polygon.corner)
            corner += Vec2(x, y);
        return polygon;
    };
    CHECK_FALSE(lie_over(square, moved(1, 0)));
    CHECK_FALSE(lie_over(square, moved(1, 1)));
    CHECK_FALSE(lie_over(square, moved(1 - 1e-9, 0)));
    CHECK(lie_over(square, moved(.9, .9)));
    CHECK(lie_over(square, square));
    const LaidPolygon triangle{{Vec2(.6, 1.2), {1.2, .6}, {1.2, 1.2}, {1.2, 1.2}}};
    CHECK(lie_over(square, triangle));
    const LaidPolygon beyond{{Vec2(.9, 1.2), {1.2, .9}, {1.2, 1.2}, {1.2, 1.2}}};
    CHECK_FALSE(lie_over(square, beyond));
    const std::vector<LaidPolygon> row{square, moved(.5, 0), moved(1, 0), moved(3, 0)};
    CHECK(lie_over_earlier(row) == std::vector<bool>{false, true, false, false});
    CHECK(find_flat_overlap(row).has_value());
    CHECK_FALSE(find_flat_overlap(std::vector<LaidPolygon>{square, moved(1, 0)}).has_value());
}

TEST_CASE("rectangles are packed apart from each other, and densely") {
    Rng rng(3);
    std::vector<PackedRectangle> rectangles;
    int area = 0;
    for (int k = 0; k < 300; ++k) {
        rectangles.push_back(
            {4 + static_cast<int>(40 * rng.uniform()), 4 + static_cast<int>(20 * rng.uniform())});
        area += rectangles.back().width * rectangles.back().height;
    }
    const int side = static_cast<int>(std::sqrt(area / .85));
    REQUIRE(pack_rectangles(rectangles, side));
    for (PackedRectangle& rectangle : rectangles)
        if (rectangle.turned)
            std::swap(rectangle.width, rectangle.height);
    std::vector<int> used(static_cast<std::size_t>(side * side));
    for (const PackedRectangle& rectangle : rectangles) {
        REQUIRE(rectangle.column + rectangle.width <= side);
        REQUIRE(rectangle.row + rectangle.height <= side);
        for (int y = 0; y < rectangle.height; ++y)
            for (int x = 0; x < rectangle.width; ++x)
                ++used[static_cast<std::size_t>((rectangle.row + y) * side + rectangle.column + x)];
    }
    CHECK(*std::ranges::max_element(used) == 1);
    CHECK_FALSE(pack_rectangles(rectangles, static_cast<int>(std::sqrt(area)) - 1));
}

TEST_CASE("a closed surface of a thousand triangles takes few charts, flat and hardly stretched") {
    for (const Scene& scene : {sphere(4, 1, .5, 1), torus(32, 16)}) {
        const Mesh mesh(scene);
        const std::vector<LightmapChart> charts = find_charts(mesh, 512);
        CAPTURE(scene.facets.size(), charts.size());
        CHECK(charts.size() <= 20);
        std::set<std::uint32_t> facets;
        for (const LightmapChart& chart : charts) {
            CHECK(stretch_of(mesh, chart) < 2.6);
            CHECK(is_flat(mesh, chart));
            for (const ChartSide& side : chart.sides)
                CHECK(facets.insert(side.facet).second);
        }
        CHECK(facets.size() == scene.facets.size());
    }
}

TEST_CASE("the charts of a room fill three quarters of the square, along its walls") {
    Scene scene = box_room({0, 0, 0}, {5, 2.6, 4}, 1, {{"a", Vec3(0.5), Vec3(1)}}, {});
    Rng rng(1);
    for (int k = 0; k < 40; ++k) {
        const Vec3 low(4.5 * rng.uniform(), 0, 3.5 * rng.uniform());
        const double x = rng.uniform(), y = rng.uniform(), z = rng.uniform();
        add_block(scene, low, low + Vec3(.1) + .3 * Vec3(x, y, z));
    }
    const Mesh mesh(scene);
    constexpr double size = 1024;
    double texels = 0;
    for (const LightmapChart& chart : find_charts(mesh, int(size))) {
        texels += double(chart.columns) * chart.rows;
        for (const Vec3& axis : {chart.along, chart.across})
            CHECK(std::max({std::abs(axis.x), std::abs(axis.y), std::abs(axis.z)}) > .9999);
    }
    CHECK(texels > .75 * size * size);
}

TEST_CASE("a density of texels gives the size that it needs") {
    const Mesh mesh(box_room({0, 0, 0}, {2, 2, 2}, 1, {{"a", Vec3(0.5), Vec3(1)}}, {}));
    const double of_metre = mesh.frame().scale;
    const Atlas atlas =
        make_atlas(mesh, sides_with_light(mesh), {.density = 20 / of_metre, .margin = 3});
    for (const LightmapChart& chart : atlas.charts)
        CHECK(chart.columns == 41);
    CHECK(atlas.size >= 115);
    CHECK(atlas.size <= 160);
    CHECK(atlas.size % 16 == 0);
    CHECK_THROWS_AS(
        make_atlas(mesh, sides_with_light(mesh), {.size = 100, .density = 20 / of_metre}),
        LightmapTooSmall);
}
