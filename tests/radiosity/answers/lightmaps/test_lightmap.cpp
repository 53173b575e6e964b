// The charts of a lightmap and what they show.
#include "radiosity/answers/lightmaps/lightmap.h"
#include "radiosity/answers/vertices/smooth.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/catch.h"
#include "support/scenes.h"

#include <algorithm>
#include <cmath>
#include <map>

using namespace hemilux;
using namespace hemilux::test;

namespace {

/// A sphere whose light falls off steeply from one point of it.
Vec3 steep_light(const Vec3& p) {
    const Vec3 gap = p - Vec3(0.3, 0.2, 0.9);
    return Vec3(1, 2, 0.5) / (0.1 + glm::dot(gap, gap));
}

std::vector<Vec3> light_of(const ChartCorners& corners) {
    std::vector<Vec3> light;
    for (const Vec3& position : corners.classes.position)
        light.push_back(steep_light(position));
    return light;
}

/// As viewers interpolate between the middles of texels.
Vec3 bilinear(const Image& image, const Vec2& place) {
    const Vec2 at = place - 0.5, low = glm::floor(at);
    const auto texel = [&](int x, int y) {
        return Vec3(image.at(static_cast<int>(low.x) + x, static_cast<int>(low.y) + y));
    };
    const Vec2 share = at - low;
    return glm::mix(glm::mix(texel(0, 0), texel(1, 0), share.x),
                    glm::mix(texel(0, 1), texel(1, 1), share.x), share.y);
}

/// Places of the two charts along each edge that smooth surfaces share, several an edge.
std::vector<std::pair<Vec2, Vec2>> seams(const Mesh& mesh, const ChartCorners& corners) {
    using Ends = std::pair<std::uint32_t, std::uint32_t>; // classes
    std::map<Ends, std::pair<Vec2, Vec2>> of_edge;        // places of the ends in the first chart
    std::vector<std::pair<Vec2, Vec2>> places;
    for (std::size_t i = 0; i < mesh.patches().size(); ++i) {
        const auto& corner = corners.classes.of_patch[i];
        const auto count = static_cast<std::size_t>(mesh.patches()[i].shape.size());
        for (std::size_t c = 0; c < count; ++c) {
            std::uint32_t a = corner[c], b = corner[(c + 1) % count];
            if (corners.class_of[a] > corners.class_of[b])
                std::swap(a, b);
            const std::pair here(corners.place[a], corners.place[b]);
            const auto [at, is_new] =
                of_edge.emplace(Ends(corners.class_of[a], corners.class_of[b]), here);
            if (!is_new && at->second != here)
                for (const double t : {0.0, 0.2, 0.5, 0.7})
                    places.emplace_back(glm::mix(at->second.first, at->second.second, t),
                                        glm::mix(here.first, here.second, t));
        }
    }
    return places;
}

double relative_gap(const Vec3& a, const Vec3& b) {
    return glm::distance(a, b) / std::max(glm::length(a), glm::length(b));
}

} // namespace

TEST_CASE("each wall of a room is one chart, and charts lie apart") {
    const Mesh mesh(box_room({0, 0, 0}, {3, 2, 5}, 4, {{"a", Vec3(0.5), Vec3(1)}}, {}));
    const std::vector<LightmapChart> charts = find_charts(mesh, 256);
    CHECK(charts.size() == 6);
    for (const LightmapChart& a : charts) {
        CHECK(a.column >= gutter);
        CHECK(a.row >= gutter);
        CHECK(a.column + a.columns + gutter <= 256);
        CHECK(a.row + a.rows + gutter <= 256);
        const Vec2 extent = a.high - a.low; // texels are squares, but for rounding
        CHECK((a.columns - 1) / extent.x == Approx((a.rows - 1) / extent.y).epsilon(0.05));
        for (const LightmapChart& b : charts)
            if (&a != &b)
                CHECK((a.column + a.columns + 2 * gutter <= b.column ||
                       b.column + b.columns + 2 * gutter <= a.column ||
                       a.row + a.rows + 2 * gutter <= b.row ||
                       b.row + b.rows + 2 * gutter <= a.row));
    }
}

TEST_CASE("materials and both sides of a face have charts of their own; suns and skies none") {
    Scene scene = box_room({0, 0, 0}, {1, 1, 1}, 1,
                           {{"a", Vec3(0.5), Vec3(1)}, {"b", Vec3(0.5), Vec3(0)}}, {0, 1});
    scene.facets.resize(1);
    CHECK(find_charts(Mesh(scene, {.two_sided = true}), 64).size() == 2);
    add_quad(scene, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 1, 1, 0);
    add_quad(scene, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, 1, 1, 1);
    const std::size_t with_both = find_charts(Mesh(scene), 64).size();
    scene.materials[1].is_far = true;
    CHECK(find_charts(Mesh(scene), 64).size() == with_both - 1);
}

TEST_CASE(
    "light in a lightmap is that of the vertices, with seams below 2 % of the light beside them") {
    for (const double max_edge : {0.0, 0.06}) { // a chart has one patch, or many
        const Mesh mesh(sphere(2, 1, 0.5, 1), {.max_edge = max_edge});
        const CornerClasses classes = find_corner_classes(mesh);
        const std::vector<LightmapChart> charts = find_charts(mesh, 1024);
        const ChartCorners corners = divide_by_charts(mesh, classes, charts);
        const std::vector<Vec3> light = light_of(corners);
        const Image picture = lightmap(charts, corners, light, 1024);
        CHECK(charts.size() < 20);

        const auto places = seams(mesh, corners);
        REQUIRE(places.size() >= 4 * 3 * charts.size() / 2);
        double seam = 0, off = 0;
        for (const auto& [a, b] : places)
            seam = std::max(seam, relative_gap(bilinear(picture, a), bilinear(picture, b)));
        for (std::size_t k = 0; k < light.size(); ++k)
            off = std::max(off, relative_gap(bilinear(picture, corners.place[k]), light[k]));
        CAPTURE(max_edge, seam, off);
        CHECK(seam < 0.02);
        CHECK(off < 0.02);
    }
}

TEST_CASE("the edges of a rectangle are exact in a lightmap") {
    const Mesh mesh(box_room({0, 0, 0}, {3, 2, 5}, 4, {{"a", Vec3(0.5), Vec3(1)}}, {}));
    const std::vector<LightmapChart> charts = find_charts(mesh, 128);
    const ChartCorners corners = divide_by_charts(mesh, find_corner_classes(mesh), charts);
    std::vector<Vec3> light;
    for (const Vec3& p : corners.classes.position)
        light.emplace_back(3.0 + p.x + 2 * p.y - p.z); // linear on each wall
    const Image picture = lightmap(charts, corners, light, 128);
    for (std::size_t k = 0; k < light.size(); ++k)
        CHECK(relative_gap(bilinear(picture, corners.place[k]), light[k]) < 1e-6);
}

TEST_CASE("a lightmap too small for its charts is refused") {
    CHECK_THROWS_AS(find_charts(Mesh(sphere(2, 1, 0.5, 1)), 16), LightmapTooSmall);
}
