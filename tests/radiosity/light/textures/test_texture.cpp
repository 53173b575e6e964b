// Means of textures over polygons, beside sums over many points.

#include "radiosity/engine/cells/refine.h"
#include "radiosity/light/textures/scene_textures.h"
#include "radiosity/light/textures/texture.h"

#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/catch.h"

#include <array>
#include <cmath>
#include <memory>

using namespace hemilux;

namespace {

std::array<double, 256> proportional() {
    std::array<double, 256> table{};
    for (std::size_t k = 0; k < table.size(); ++k)
        table[k] = double(k) / 255;
    return table;
}

Texture noise(std::uint32_t width, std::uint32_t height) {
    Rng rng(7);
    std::vector<std::uint8_t> rgb(std::size_t{3} * width * height);
    for (std::uint8_t& byte : rgb)
        byte = static_cast<std::uint8_t>(255 * rng.uniform());
    return {width, height, rgb, proportional()};
}

/// Columns of brightness 0, 1/4, 1/2 and 1 in red; green is the row over 2.
Texture steps() {
    std::vector<std::uint8_t> rgb;
    for (int row = 0; row < 2; ++row)
        for (const int red : {0, 51, 102, 255})
            rgb.insert(rgb.end(), {std::uint8_t(red), std::uint8_t(255 * row), 0});
    return {4, 2, rgb, proportional()};
}

std::vector<Vec2> box(double x0, double y0, double x1, double y1) {
    return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

} // namespace

TEST_CASE("means over boxes follow from areas", "[texture]") {
    const Texture texture = steps();
    CHECK(texture.mean_over(box(0, 0, 1, 1), {}).x == Approx(.4));
    CHECK(texture.mean_over(box(0, 0, 1, 1), {}).y == Approx(.5));
    CHECK(texture.mean_over(box(.25, 0, .5, .5), {}).x == Approx(.2));
    CHECK(texture.mean_over(box(.25, 0, .5, .5), {}).y == Approx(0));
    CHECK(texture.mean_over(box(.375, .25, .875, .75), {}).x == Approx(.25 * .2 + .5 * .4 + .25));
    CHECK(texture.mean_over(box(.6, .1, .6001, .1001), {}).x == Approx(.4));
    // Turned around, the same.
    std::vector<Vec2> reversed = box(.375, .25, .875, .75);
    std::reverse(reversed.begin(), reversed.end());
    CHECK(texture.mean_over(reversed, {}).x == Approx(.5));
}

TEST_CASE("beyond the picture it repeats, is mirrored or goes on", "[texture]") {
    const Texture texture = steps();
    const auto red = [&](double x, Wrap wrap) {
        return texture.mean_over(box(x, 0, x + .25, 1), {wrap, wrap}).x;
    };
    CHECK(red(1.25, Wrap::repeat) == Approx(.2));
    CHECK(red(-.5, Wrap::repeat) == Approx(.4));
    CHECK(red(-1000.5, Wrap::repeat) == Approx(.4));
    CHECK(red(1, Wrap::mirror) == Approx(1));
    CHECK(red(1.5, Wrap::mirror) == Approx(.2));
    CHECK(red(-.5, Wrap::mirror) == Approx(.2));
    CHECK(red(2.25, Wrap::mirror) == Approx(.2));
    CHECK(red(7, Wrap::clamp) == Approx(1));
    CHECK(red(-3, Wrap::clamp) == Approx(0).margin(1e-12));
    // Half of it outside.
    CHECK(texture.mean_over(box(.75, 0, 1.25, 1), {Wrap::clamp, Wrap::clamp}).x == Approx(1));
    CHECK(texture.mean_over(box(.75, 0, 1.25, 1), {}).x == Approx(.5));
    CHECK(texture.mean_over(box(-.25, 0, .5, 1), {Wrap::mirror, Wrap::clamp}).x == Approx(.2 / 3));
}

TEST_CASE("means over triangles are those of many points", "[texture]") {
    const Texture texture = noise(37, 21);
    Rng rng(3);
    for (const Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::mirror})
        for (int run = 0; run < 8; ++run) {
            const double size = std::pow(10, -1.5 + 2 * rng.uniform());
            std::vector<Vec2> triangle;
            for (int k = 0; k < 3; ++k)
                triangle.emplace_back(size * (rng.uniform() - .3), size * (rng.uniform() - .3));
            // Small squares, each of one texel nearly everywhere, stand for points.
            Vec3 sum(0.0);
            constexpr int n = 20000;
            for (int i = 0; i < n; ++i) {
                const double a = std::sqrt(rng.uniform()), b = rng.uniform();
                const Vec2 p =
                    (1 - a) * triangle[0] + a * (1 - b) * triangle[1] + a * b * triangle[2];
                sum += texture.mean_over(box(p.x, p.y, p.x + 1e-7, p.y + 1e-7), {wrap, wrap}) /
                       double(n);
            }
            const Vec3 mean = texture.mean_over(triangle, {wrap, wrap});
            CAPTURE(run, size);
            for (int c = 0; c < 3; ++c) // five standard errors of numbers from 0 to 1
                CHECK(std::abs(mean[c] - sum[c]) < 5 * .3 / std::sqrt(n));
        }
}

TEST_CASE("the means of small triangles make up that of the picture", "[texture]") {
    constexpr std::uint32_t width = 64, height = 48;
    std::vector<std::uint8_t> bytes;
    for (std::uint32_t k = 0; k < 3 * width * height; ++k)
        bytes.push_back(static_cast<std::uint8_t>(hash_words({k})));
    const Texture texture(width, height, bytes, srgb_to_linear());
    constexpr int n = 37;
    Vec3 sum(0.0);
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const Vec2 a = Vec2(x, y) / double(n), b = Vec2(x + 1, y) / double(n),
                       c = Vec2(x + 1, y + 1) / double(n), d = Vec2(x, y + 1) / double(n);
            sum += texture.mean_over(std::array{a, b, c}, {}) +
                   texture.mean_over(std::array{a, c, d}, {});
        }
    for (int channel = 0; channel < 3; ++channel)
        CHECK(sum[channel] / (2 * n * n) == Approx(texture.mean()[channel]).epsilon(1e-12));
}

TEST_CASE("polygons without area and huge ones have means too", "[texture]") {
    const Texture texture = steps();
    const std::vector<Vec2> point(3, Vec2(.6, .2)), line{{.5, .2}, {.7, .2}, {.6, .2}};
    CHECK(texture.mean_over(point, {}).x == Approx(.4));
    CHECK(texture.mean_over(line, {}).x == Approx(.4));
    CHECK(texture.mean_over(box(0, 0, 1e6, 1e6), {}) == texture.mean());
    const double nan = std::nan("");
    CHECK(texture.mean_over(box(nan, 0, 1, 1), {}) == texture.mean());
    CHECK(texture.mean_over(std::vector<Vec2>{{0, 0}, {1, 0}, {1, nan}}, {}) == texture.mean());
}

TEST_CASE("sRGB bytes mean light by the curve of the standard", "[texture]") {
    CHECK(srgb_to_linear()[0] == 0);
    CHECK(srgb_to_linear()[255] == Approx(1));
    CHECK(srgb_to_linear()[188] == Approx(.5029).epsilon(1e-3));
    CHECK(srgb_to_linear()[10] == Approx(10 / 255.0 / 12.92));
}

TEST_CASE("patches have the means of their own parts of a texture", "[texture]") {
    Scene scene;
    scene.vertices = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
    const bool quad = GENERATE(false, true);
    scene.facets = {{{0, 1, 2, quad ? 3u : 2u}, 0, 0, 0}};
    scene.materials.push_back({"m", Vec3(.2), Vec3(0.0)});
    scene.groups = {"g"};
    scene.faces = 1;
    own_textures_of(scene).of_material.resize(1);
    TextureMap& map = own_textures_of(scene).of_material[0].reflectance;
    map.texture = std::make_shared<const Texture>(steps());
    map.factor = Vec3(.5);
    own_textures_of(scene).texcoords = {{Texcoords{{{0, 0}, {1, 0}, {1, 1}, {quad ? 0 : 1, 1}}}}};
    Mesh whole(scene);
    CHECK(whole.material(0).reflectance.y == Approx(quad ? .25 : .125));
    const Mesh divided(scene, {.max_edge = 1});
    Vec3 sum(0.0);
    double area = 0;
    for (const Patch& patch : divided.patches()) {
        sum += patch.area * divided.material(patch).reflectance;
        area += patch.area;
        if (!quad)
            continue;
        const double x = divided.frame().to_world(patch.centre).x;
        const std::array<double, 4> red{0, .1, .2, .5};
        CHECK(divided.material(patch).reflectance.x ==
              Approx(red.at(static_cast<std::size_t>(x))).margin(1e-12));
    }
    CHECK(glm::length(sum / area - whole.material(0).reflectance) < 1e-9);
    const std::vector<std::uint8_t> levels(1, 2);
    refine(whole, levels);
    sum = Vec3(0.0);
    for (const Patch& patch : whole.patches())
        sum += patch.area * whole.material(patch).reflectance;
    CHECK(whole.patches().size() == 16);
    CHECK(glm::length(sum / area - Vec3(.5) * (quad ? steps().mean() : sum / area / .5)) < 1e-9);
}
