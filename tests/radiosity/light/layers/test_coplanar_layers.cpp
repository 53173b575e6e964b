// Facets that lie over each other in one plane: all are found, and offset in an order.
#include "geometry/flat_polygon.h"
#include "geometry/frame.h"
#include "radiosity/light/layers/coplanar_layers.h"
#include "radiosity/light/layers/coplanar_overlaps.h"
#include "radiosity/light/layers/layered_mesh.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/catch.h"
#include "support/scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

using namespace hemilux;
using test::add_quad;

namespace {

enum : std::uint32_t { grey, dim, bright };

Scene empty_scene() {
    Scene scene;
    scene.materials = {{"grey", Vec3(.5), Vec3(0.0)},
                       {"dim", Vec3(.5), Vec3(1.0)},
                       {"bright", Vec3(.5), Vec3(2.0)}};
    scene.groups = {"default"};
    return scene;
}

/// In the plane y = 0, facing up, or down.
void add_square(Scene& scene, double x, double z, double size, std::uint32_t material,
                bool up = true) {
    const Vec3 a(x, 0, z), b(x, 0, z + size), c(x + size, 0, z + size), d(x + size, 0, z);
    up ? add_quad(scene, a, b, c, d, 1, 1, material) : add_quad(scene, a, d, c, b, 1, 1, material);
}

/// n x n squares that share their vertices.
Scene tiled_floor(std::uint32_t n) {
    Scene scene = empty_scene();
    for (std::uint32_t k = 0; k < (n + 1) * (n + 1); ++k)
        scene.vertices.push_back(Vec3(k % (n + 1), 0, k / (n + 1)) / double(n));
    for (std::uint32_t k = 0; k < n * n; ++k) {
        const std::uint32_t v = k / n * (n + 1) + k % n;
        scene.facets.push_back({{v, v + n + 1, v + n + 2, v + 1}, scene.faces++, grey, 0});
    }
    return scene;
}

CoplanarLayers layers_of(const Scene& scene) {
    return find_coplanar_layers(scene, LocalFrame::of(scene).to_local(scene.vertices));
}

std::vector<std::int32_t> offsets_of(const Scene& scene) { return layers_of(scene).offset; }

using Pairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

Pairs pairs_of(const Scene& scene) {
    Pairs pairs;
    for (const auto& [a, b] :
         find_overlaps(scene, LocalFrame::of(scene).to_local(scene.vertices)).pairs)
        pairs.emplace(a, b);
    return pairs;
}

/// Triangles and squares of random places, sizes and facings.
FlatPolygon random_shape(Rng& rng) {
    const double angle = 6.283 * rng.uniform(), size = .02 + .2 * rng.uniform() * rng.uniform();
    const Vec2 centre(2 * rng.uniform() - 1, 2 * rng.uniform() - 1);
    const std::size_t corners = rng.uniform() < .5 ? 3 : 4;
    FlatPolygon shape;
    for (std::size_t k = 0; k < corners; ++k) {
        const double a = angle + 6.28318530718 * double(k) / double(corners);
        shape.add(centre + size * Vec2(std::cos(a), std::sin(a)));
    }
    return shape;
}

void add_facet(Scene& scene, const FlatPolygon& shape, const Frame& frame, double height,
               bool flipped, const auto& error) {
    Facet facet{.vertex = {}, .face = scene.faces++, .material = grey, .group = 0};
    for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t corner =
            std::min(flipped ? shape.size - 1 - std::min(k, shape.size - 1) : k, shape.size - 1);
        if (k < shape.size) {
            scene.vertices.push_back(frame.to_world(Vec3(shape.corner[corner], height)) + error());
            facet.vertex[k] = static_cast<std::uint32_t>(scene.vertices.size() - 1);
        } else
            facet.vertex[k] = facet.vertex[k - 1];
    }
    scene.facets.push_back(facet);
}

} // namespace

TEST_CASE("Overlaps are found in planes of any direction, and no others") {
    constexpr double noise = 0x1p-40; // of a scene that is about 4 wide
    Rng rng(5);
    const auto error = [&] {
        return noise * (Vec3(rng.uniform(), rng.uniform(), rng.uniform()) - .5);
    };
    std::size_t found = 0;
    for (int round = 0; round < 8; ++round) {
        Scene scene = empty_scene();
        Pairs expected;
        for (int plane = 0; plane < 60; ++plane) {
            const Vec3 normal(rng.uniform() - .5, rng.uniform() - .5, rng.uniform() - .5);
            const Frame frame = plane % 4 == 0 ? Frame::from_normal({0, 0, 1})
                                               : Frame::from_normal(glm::normalize(normal));
            const double height = 2 * rng.uniform() - 1;
            std::vector<FlatPolygon> shapes;
            const auto first = static_cast<std::uint32_t>(scene.facets.size());
            for (std::uint32_t i = 0; i < 6 + 30 * (plane % 3 == 0); ++i) {
                const FlatPolygon shape = random_shape(rng);
                for (std::uint32_t j = 0; j < shapes.size(); ++j) {
                    const double common = common_part(shapes[j], shape).area();
                    if (common > 0x1p-13 * std::min(shapes[j].area(), shape.area()))
                        expected.emplace(first + j, first + i);
                }
                shapes.push_back(shape);
                add_facet(scene, shape, frame, height, rng.uniform() < .5, error);
            }
        }
        CHECK(pairs_of(scene) == expected);
        found += expected.size();
    }
    CHECK(found > 300);
}

TEST_CASE("Neighbours are not overlaps: nothing of a closed mesh or a floor of tiles is moved") {
    std::vector<Scene> scenes{test::sphere(4, 3, .5, 1), test::room_with_block(),
                              test::furnace_box(12, .5), test::furnace_l_shape(.5)};
    scenes.push_back(tiled_floor(300));
    const Frame oblique = Frame::from_normal(glm::normalize(Vec3(.3, .5, .8))).turned(.7);
    for (std::size_t k = 0, n = scenes.size(); k < n; ++k) {
        Scene turned = scenes[k];
        for (Vec3& v : turned.vertices)
            v = oblique.to_world(v) + Vec3(1e4, 2e4, 3e4);
        scenes.push_back(turned);
    }
    for (const Scene& scene : scenes) {
        CHECK(offsets_of(scene).empty());
        const Mesh mesh = layered_mesh(scene);
        REQUIRE(mesh.vertices().size() == scene.vertices.size());
        bool same = true;
        for (std::size_t v = 0; v < scene.vertices.size(); ++v)
            same = same && mesh.vertices()[v] == mesh.frame().to_local(scene.vertices[v]);
        CHECK(same);
    }
}

TEST_CASE("Of two that face one way the brighter is on top, else the smaller, else the first") {
    const auto offset = [](double size, std::uint32_t a, std::uint32_t b, bool up) {
        Scene scene = empty_scene();
        add_square(scene, 0, 0, 1, a, up);
        add_square(scene, .3, .4, size, b, up);
        const std::vector<std::int32_t> offsets = offsets_of(scene);
        return offsets[1] - offsets[0];
    };
    for (const bool up : {true, false}) {
        CHECK(offset(1, grey, grey, up) == -1);
        CHECK(offset(1.01, grey, grey, up) == -1);
        CHECK(offset(.5, grey, grey, up) == 1);
        CHECK(offset(2, grey, grey, up) == -1);
        CHECK(offset(2, grey, dim, up) == 1);
        CHECK(offset(.5, bright, dim, up) == -1);
    }
}

TEST_CASE("The largest area stays where it is") {
    Scene lamp = empty_scene(); // on four tiles of nine
    add_quad(lamp, {0, 0, 0}, {0, 0, 3}, {3, 0, 3}, {3, 0, 0}, 3, 3, grey);
    add_square(lamp, .5, .5, 1, bright);
    std::vector<std::int32_t> expected(10, 0);
    expected[9] = 1;
    CHECK(offsets_of(lamp) == expected);
    CHECK(layers_of(lamp).covered == 4);

    Scene carpet = empty_scene(); // larger than the tiles that it reaches, and so beneath them
    add_square(carpet, .5, .5, 1.9, grey);
    add_quad(carpet, {0, 0, 0}, {0, 0, 3}, {3, 0, 3}, {3, 0, 0}, 3, 3, grey);
    expected.assign(10, 0);
    expected[0] = -1;
    CHECK(offsets_of(carpet) == expected);
    CHECK(layers_of(carpet).covered == 1);
}

TEST_CASE("Two sides of a wall, divided in different ways, lie to their fronts") {
    Scene scene = empty_scene();
    add_quad(scene, {0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}, 3, 3, grey);
    add_quad(scene, {0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}, 4, 5, grey);
    const CoplanarLayers layers = layers_of(scene);
    CHECK(layers.covered == 0);
    for (std::size_t f = 1; f < 9; ++f)
        CHECK(layers.offset[f] == layers.offset[0]);
    for (std::size_t f = 9; f < 29; ++f)
        CHECK(layers.offset[f] == 1 - layers.offset[0]);
}

TEST_CASE("A chain of alike decals takes two levels; a pile takes one each") {
    Scene chain = empty_scene(), pile = empty_scene();
    for (int k = 0; k < 500; ++k)
        add_square(chain, .7 * k, .2 * (k % 3), 1, grey);
    for (int k = 0; k < 20; ++k)
        add_square(pile, .01 * k, 0, 1, grey);
    const std::vector<std::int32_t> offsets = offsets_of(chain);
    for (std::size_t k = 1; k < 500; ++k)
        CHECK(std::abs(offsets[k] - offsets[k - 1]) == 1);
    CHECK(std::set(offsets.begin(), offsets.end()).size() == 2);
    const std::vector<std::int32_t> piled = offsets_of(pile);
    for (std::size_t k = 1; k < 20; ++k)
        CHECK(piled[k - 1] == piled[k] + 1); // the first on top
    CHECK(layers_of(pile).covered == 19);
}

TEST_CASE("Whatever overlaps is offset, each side to its front") {
    Rng rng(3);
    Scene scene = empty_scene();
    for (int k = 0; k < 400; ++k) {
        std::array<double, 5> u; // in this order, whatever the compiler
        for (std::size_t i = u.size(); i-- > 0;)
            u[i] = rng.uniform();
        add_square(scene, 4 * u[0], 4 * u[1], .1 + .9 * u[2], static_cast<std::uint32_t>(3 * u[3]),
                   u[4] < .7);
    }
    const std::vector<std::int32_t> offsets = offsets_of(scene);
    const auto is_up = [&](std::uint32_t f) {
        const auto& v = scene.facets[f].vertex;
        return scene.vertices[v[1]].x == scene.vertices[v[0]].x;
    };
    const auto height = [&](std::uint32_t f) { return is_up(f) ? offsets[f] : -offsets[f]; };
    for (const auto& [a, b] : pairs_of(scene)) {
        if (is_up(a) != is_up(b))
            CHECK((is_up(a) ? height(a) > height(b) : height(a) < height(b)));
        else if (scene.facets[a].material != scene.facets[b].material)
            CHECK((scene.facets[a].material > scene.facets[b].material) ==
                  (offsets[a] > offsets[b]));
        else
            CHECK(offsets[a] != offsets[b]);
    }
    CHECK(*std::ranges::max_element(offsets) < 40);
    CHECK(std::ranges::count(offsets, 0) > 20); // what lies lowest, and what lies alone
}

/// A fan of triangles around one point, each as wide as its share of the circle or a little wider.
Scene fan(int n, double share) {
    constexpr double circle = 2 * std::numbers::pi;
    Scene scene = empty_scene();
    for (int k = 0; k < n; ++k) {
        const double a = circle * k / n, b = circle * (k + share) / n;
        add_facet(scene,
                  {{Vec2(0), Vec2(std::cos(a), std::sin(a)), Vec2(std::cos(b), std::sin(b))}, 3},
                  Frame::from_normal({0, 0, 1}), 0, false, [] { return Vec3(0.0); });
    }
    return scene;
}

TEST_CASE("Triangles around one point are no overlaps, unless they are wider than their share") {
    CHECK(pairs_of(fan(5000, 1)).empty());
    CHECK(pairs_of(fan(500, 1.25)).size() == 500);
    const Scene many = fan(20'000, 1);
    CHECK(find_overlaps(many, LocalFrame::of(many).to_local(many.vertices)).complete);
}

TEST_CASE("Slivers whose boxes all overlap make the pairs that each with each makes") {
    Scene scene = empty_scene();
    std::vector<FlatPolygon> shapes;
    Rng rng(5);
    for (int k = 0; k < 700; ++k) { // along a diagonal, most of them beside each other
        const Vec2 middle(rng.uniform(), rng.uniform() / 2);
        const Vec2 along = (.05 + .4 * rng.uniform()) * Vec2(1, 1 + .2 * rng.uniform());
        const Vec2 wide = (1e-4 + 3e-3 * rng.uniform()) * Vec2(-1, 1);
        const FlatPolygon shape{{middle - along - wide, middle + along - wide,
                                 middle + along + wide, middle - along + wide},
                                4};
        add_facet(scene, shape, Frame::from_normal({0, 0, 1}), 0, false, [] { return Vec3(0.0); });
        shapes.push_back(shape);
    }
    const auto is_clear = [&](std::size_t i, std::size_t j, double share) {
        const double smaller = std::min(shapes[i].area(), shapes[j].area());
        return common_part(shapes[i], shapes[j]).area() > share * smaller;
    };
    const Pairs found = pairs_of(scene);
    std::size_t missed = 0, wrong = 0;
    for (std::uint32_t i = 0; i < shapes.size(); ++i)
        for (std::uint32_t j = i + 1; j < shapes.size(); ++j) {
            const bool is_found = found.contains({i, j});
            missed += is_clear(i, j, 0x1p-12) && !is_found; // the limit is 2^-13
            wrong += !is_clear(i, j, 0x1p-14) && is_found;
        }
    CHECK(found.size() > 1000);
    CHECK(missed == 0);
    CHECK(wrong == 0);
}

TEST_CASE("More slivers over each other than can be compared are reported") {
    Scene scene = fan(300, 60);
    const std::vector<Vec3> local = LocalFrame::of(scene).to_local(scene.vertices);
    CHECK(find_overlaps(scene, local).complete);
    CHECK_FALSE(find_overlaps(scene, local, {1000, 1000}).complete);
}
