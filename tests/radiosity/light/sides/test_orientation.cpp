// Faces that look away from the light: found where the evidence is clear, left alone where not.
#include "geometry/polygon.h"
#include "radiosity/light/sides/orientation.h"
#include "radiosity/light/sides/shells.h"
#include "radiosity/paper/sampling/rng.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/sided_scenes.h"
#include "support/solve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace hemilux;
using test::add_quad;
using test::box_room;

namespace {

enum : std::uint32_t { wall, lamp, clay };

const std::vector<Material> materials{{"wall", Vec3(.6), Vec3(0.0)},
                                      {"lamp", Vec3(.1), Vec3(8, 7, 5)},
                                      {"clay", Vec3(.5), Vec3(0.0)}};
constexpr std::array<std::uint32_t, 6> all_walls{wall, wall, wall, wall, wall, wall};
constexpr std::array<std::uint32_t, 6> all_lamps{lamp, lamp, lamp, lamp, lamp, lamp};
constexpr std::array<std::uint32_t, 6> all_clay{clay, clay, clay, clay, clay, clay};

Scene empty_scene() {
    Scene scene;
    scene.materials = materials;
    scene.groups = {"default"};
    return scene;
}

/// Faces of `from` become faces of `to`, turned or not.
void add(Scene& to, const Scene& from, bool turned = false) {
    const auto first = static_cast<std::uint32_t>(to.vertices.size());
    to.vertices.insert(to.vertices.end(), from.vertices.begin(), from.vertices.end());
    for (Facet facet : from.facets) {
        for (std::uint32_t& v : facet.vertex)
            v += first;
        if (turned)
            std::swap(facet.vertex[1], facet.vertex[facet.is_triangle() ? 2 : 3]);
        if (turned && facet.vertex[3] == facet.vertex[1])
            facet.vertex[3] = facet.vertex[2];
        facet.face += to.faces;
        to.facets.push_back(facet);
    }
    to.faces += from.faces;
}

Scene room(const Vec3& low, const Vec3& high,
           const std::array<std::uint32_t, 6>& material = all_walls) {
    return box_room(low, high, 2, materials, material);
}
/// A solid seen from outside.
void add_block(Scene& scene, const Vec3& low, const Vec3& high,
               const std::array<std::uint32_t, 6>& material = all_clay) {
    add(scene, room(low, high, material), true);
}

/// A square of the plane y = height.
void add_lamp(Scene& scene, double x, double height, double z, double half, bool up) {
    const Vec3 a(x - half, height, z - half), b(x + half, height, z - half),
        c(x + half, height, z + half), d(x - half, height, z + half);
    up ? add_quad(scene, a, d, c, b, 1, 1, lamp) : add_quad(scene, a, b, c, d, 1, 1, lamp);
}

/// A room with a block on the floor and a lamp under the ceiling, all right.
Scene furnished_room() {
    Scene scene = room({0, 0, 0}, {4, 3, 4});
    add_block(scene, {1, 0.01, 1}, {2, 1, 2});
    add_lamp(scene, 2, 2.95, 2, 0.4, false);
    return scene;
}

using Faces = std::vector<bool>;

Scene with_turned(Scene scene, const Faces& turned) {
    Orientation change;
    change.looks_away = turned;
    turn_faces(scene, change);
    return scene;
}
Faces all_faces(const Scene& scene) { return Faces(scene.faces, true); }
Faces random_half(const Scene& scene, std::uint64_t seed) {
    Rng rng(seed);
    Faces faces(scene.faces);
    for (std::size_t f = 0; f < faces.size(); ++f)
        faces[f] = rng.uniform() < 0.5;
    return faces;
}

Faces looking_away(const Scene& scene) {
    const Orientation found = find_orientation(scene);
    CHECK(found.faces == static_cast<std::size_t>(std::ranges::count(found.looks_away, true)));
    return found.looks_away.empty() ? Faces(scene.faces, false) : found.looks_away;
}

/// None is turned as it is; turned as a whole or by halves it comes back.
void check_recovered(const Scene& scene) {
    CHECK(find_orientation(scene).faces == 0);
    CHECK(looking_away(with_turned(scene, all_faces(scene))) == all_faces(scene));
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        CAPTURE(seed);
        const Faces half = random_half(scene, seed);
        CHECK(looking_away(with_turned(scene, half)) == half);
    }
}

/// A cylinder without ends about the vertical axis, facing outwards.
Scene shade(const Vec3& centre, double radius, double height, bool top) {
    constexpr int n = 24;
    Scene scene = empty_scene();
    for (int k = 0; k < n; ++k) {
        const auto at = [&](int i, double y) {
            const double angle = 2 * std::numbers::pi * (i % n) / n;
            return centre + Vec3(radius * std::cos(angle), y, -radius * std::sin(angle));
        };
        add_quad(scene, at(k, 0), at(k + 1, 0), at(k + 1, height), at(k, height), 1, 1, clay);
        if (top) {
            const auto first = static_cast<std::uint32_t>(scene.vertices.size());
            for (const Vec3& v : {at(k, height), at(k + 1, height), centre + Vec3(0, height, 0)})
                scene.vertices.push_back(v);
            scene.facets.push_back(
                {{first, first + 1, first + 2, first + 2}, scene.faces++, clay, 0});
        }
    }
    return scene;
}

} // namespace

TEST_CASE("Turning a face twice gives the same polygon") {
    Scene scene = furnished_room();
    const Scene twice = with_turned(with_turned(scene, all_faces(scene)), all_faces(scene));
    for (std::size_t f = 0; f < scene.facets.size(); ++f)
        CHECK(twice.facets[f].vertex == scene.facets[f].vertex);
    const Scene once = with_turned(scene, all_faces(scene));
    CHECK(once.facets[0].vertex[0] == scene.facets[0].vertex[0]);
    CHECK(once.facets[0].vertex[1] == scene.facets[0].vertex[3]);
}

TEST_CASE("Shells: closed, open, two-layered, and three facets at an edge") {
    Scene scene = empty_scene();
    add_block(scene, {0, 0, 0}, {1, 1, 1});
    add_quad(scene, {3, 0, 0}, {4, 0, 0}, {4, 1, 0}, {3, 1, 0}, 3, 2, wall);
    Shells shells = find_shells(scene);
    REQUIRE(shells.all.size() == 2);
    CHECK(shells.all[0].closed);
    CHECK_FALSE(shells.all[1].closed);
    CHECK(shells.all[0].consistent);
    CHECK(shells.clashing_edges == 0);

    Faces one(scene.faces);
    one[0] = true;
    shells = find_shells(with_turned(scene, one));
    CHECK(shells.clashing_edges == 4);
    CHECK_FALSE(shells.all[0].consistent);
    CHECK(shells.all[0].orientable);
    CHECK(shells.against[0]);
    CHECK(std::ranges::count(shells.against, true) == 1);

    // A face that is there twice is no neighbour of itself; a partition makes three at an edge.
    Scene layers = empty_scene();
    for (int i = 0; i < 2; ++i)
        add_quad(layers, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 1, 1, wall);
    CHECK(find_shells(layers).all.size() == 2);
    CHECK(find_shells(layers).clashing_edges == 0);
    Scene corner = empty_scene();
    add_quad(corner, {0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}, 1, 1, wall);
    add_quad(corner, {-1, 0, 0}, {-1, 0, 1}, {0, 0, 1}, {0, 0, 0}, 1, 1, wall);
    add_quad(corner, {0, 0, 1}, {0, 0, 0}, {0, 1, 0}, {0, 1, 1}, 1, 1, wall);
    CHECK(find_shells(corner).all.size() == 3);
}

TEST_CASE("Rooms, things and lamps come back from any turning") {
    SECTION("a furnished room") { check_recovered(furnished_room()); }
    SECTION("nested: a room, in it a box, in it a lamp") {
        Scene scene = room({0, 0, 0}, {4, 3, 4});
        add(scene, room({1, 1, 1}, {2, 2, 2}));
        add_block(scene, {1.3, 1.3, 1.3}, {1.6, 1.6, 1.6}, all_lamps);
        // The inner box is a room, the outer one is dark: nothing tells of its sides.
        CHECK(find_orientation(scene).faces == 0);
        const Faces found = looking_away(with_turned(scene, all_faces(scene)));
        CHECK(std::ranges::count(found, true) == 48);
    }
    SECTION("an L-shaped room") {
        Scene scene = test::furnace_l_shape(0.5, 0);
        scene.materials = materials;
        add_lamp(scene, 0.5, 0.95, 1.5, 0.2, false);
        check_recovered(scene);
    }
    SECTION("a sphere as lamp") {
        Scene scene = room({-2, -2, -2}, {2, 2, 2});
        Scene ball = test::sphere(2, 0.3, 0.1, 5);
        for (Facet& facet : ball.facets)
            facet.material = lamp;
        add(scene, ball, true);
        check_recovered(scene);
    }
    SECTION("two rooms side by side") {
        Scene scene = furnished_room();
        add(scene, room({4.2, 0, 0}, {8, 3, 4}));
        add_lamp(scene, 6, 2.9, 2, 0.5, false);
        check_recovered(scene);
    }
    SECTION("a room lit by a part of its ceiling, beside another") {
        Scene scene = room({0, 0, 0}, {4, 3, 4}, {wall, lamp, wall, wall, wall, wall});
        add(scene, room({4.2, 0, 0}, {8, 3, 4}, {wall, lamp, wall, wall, wall, wall}));
        check_recovered(scene);
    }
    SECTION("sealed furnaces") {
        check_recovered(test::furnace_box(3, 0.5));
        check_recovered(test::furnace_l_shape(0.5));
    }
    SECTION("a box without its front") {
        Scene scene = room({0, 0, 0}, {2, 2, 2});
        std::erase_if(scene.facets, [](const Facet& facet) { return facet.face >= 20; });
        scene.faces = 20;
        add_block(scene, {0.5, 0.01, 0.5}, {1, 1, 1});
        add_lamp(scene, 1, 1.98, 1, 0.3, false);
        check_recovered(scene);
    }
    SECTION("a thousand things") {
        Scene scene = room({0, 0, 0}, {20, 3, 20});
        add_lamp(scene, 10, 2.95, 10, 3, false);
        for (int k = 0; k < 1000; ++k) {
            const Vec3 low(1 + 0.5 * (k % 32), 0.01, 1 + 0.5 * (k / 32));
            add(scene, box_room(low, low + Vec3(0.2), 1, materials, all_clay), true);
        }
        check_recovered(scene);
    }
}

TEST_CASE("A lamp shines to the side where there is something to light") {
    const auto lamp_is_turned = [](double height, double half, bool up) {
        Scene scene = room({0, 0, 0}, {4, 3, 4});
        add_lamp(scene, 2, height, 2, half, up);
        const Orientation found = find_orientation(scene);
        CHECK(found.emitters == found.faces);
        return found.faces == 1;
    };
    CHECK(lamp_is_turned(2.98, 0.4, true));
    CHECK_FALSE(lamp_is_turned(2.98, 0.4, false));
    CHECK(lamp_is_turned(0.02, 0.4, false));
    // In the plane of the ceiling, as a decal is.
    CHECK(lamp_is_turned(3, 0.4, true));
    CHECK_FALSE(lamp_is_turned(3, 0.4, false));
    // Uplights, and a lamp in the middle.
    for (const bool up : {false, true}) {
        CHECK_FALSE(lamp_is_turned(2.6, 0.2, up));
        CHECK_FALSE(lamp_is_turned(1.5, 0.5, up));
    }
}

TEST_CASE("A sun is not turned with the room that it stands over") {
    // The walls of the room have their fronts outside; the sun is a square far above, open, and
    // dark as long as nobody looks at it.
    const bool closed = GENERATE(true, false);
    CAPTURE(closed);
    Scene scene = empty_scene();
    const Scene walls = room(Vec3(0, 0, 0), Vec3(4, 3, 4));
    add(scene, walls, true);
    if (!closed)
        std::erase_if(scene.facets, [&](const Facet& facet) {
            return std::ranges::all_of(facet.vertex,
                                       [&](std::uint32_t v) { return scene.vertices[v].y == 3; });
        });
    add_lamp(scene, 2, 2, 2, .5, false);
    const std::uint32_t own = scene.faces;
    scene.materials.push_back(
        {.name = "sun", .reflectance = Vec3(0.0), .emission = Vec3(100), .is_far = true});
    const auto sun = static_cast<std::uint32_t>(scene.materials.size() - 1);
    add_quad(scene, Vec3(-40, 100, -40), Vec3(40, 100, -40), Vec3(40, 100, 40), Vec3(-40, 100, 40),
             1, 1, sun);
    const Orientation found = find_orientation(scene);
    REQUIRE(found.looks_away.size() == scene.faces);
    CHECK(found.looks_away[scene.facets.front().face]);
    for (std::uint32_t face = own; face < scene.faces; ++face)
        CHECK_FALSE(found.looks_away[face]);
}

TEST_CASE("A small lamp far from a small thing in the open shines outwards") {
    Scene scene = empty_scene();
    add_block(scene, Vec3(-1), Vec3(1));
    add_block(scene, {4, 5.9, 1}, {4.01, 5.91, 1.01}, all_lamps);
    CHECK(find_orientation(scene).faces == 0);
}

TEST_CASE("A lamp shade open at the bottom stays, and is in doubt where it swallows the light") {
    for (const bool inwards : {false, true}) {
        Scene scene = room({-2, 0, -2}, {2, 3, 2});
        add(scene, shade({0, 1.5, 0}, 0.3, 0.4, true), inwards);
        add_block(scene, {-.05, 1.65, -.05}, {.05, 1.75, .05}, all_lamps);
        const Orientation found = find_orientation(scene);
        CHECK(found.faces == 0);
        CHECK(found.in_doubt == (inwards ? 0 : 48));
    }
}

namespace {

/// Power that leaves all surfaces besides what they emit.
double reflected_power(const Scene& scene) {
    const test::Model model(scene);
    SolveOptions options;
    options.rays = 200;
    const Solution solution =
        test::solve_as_needed(model, *find_method("stratified"), options, test::steps(2));
    double sum = 0;
    for (std::uint32_t i = 0; i < solution.radiosity.size(); ++i) {
        const Vec3 b = solution.radiosity[i] - model.mesh.material(i).emission;
        sum += model.mesh.patches()[i].area * (b.r + b.g + b.b);
    }
    return sum;
}

/// The light of the right scene arrives, or the program says what it has turned.
void check_mended(const Scene& scene, const Faces& turned, double expected) {
    Scene wrong = with_turned(scene, turned);
    const Orientation found = find_orientation(wrong);
    turn_faces(wrong, found);
    const double light = reflected_power(wrong) / expected;
    CHECK(light > 0.5);
    if (found.faces + found.in_doubt == 0)
        CHECK(light == Approx(1).epsilon(.03));
}

} // namespace

TEST_CASE("No face of a right scene is turned, and reversed ones are lit again", "[slow]") {
    for (const auto& [name, scene] : test::sided_scenes()) {
        CAPTURE(name);
        CHECK(find_orientation(scene).faces == 0);
        const double expected = reflected_power(scene);
        check_mended(scene, all_faces(scene), expected);
        for (const std::uint64_t seed : {1u, 2u}) {
            CAPTURE(seed);
            check_mended(scene, random_half(scene, seed), expected);
        }
    }
}

TEST_CASE("What the evidence leaves open stays as it is") {
    SECTION("a sheet that is lit from both sides") {
        for (const bool turned : {false, true}) {
            Scene scene = room({0, 0, 0}, {4, 3, 4}), sheet = empty_scene();
            add_lamp(scene, 1, 2.9, 2, 0.4, false);
            add_lamp(scene, 3, 2.9, 2, 0.4, false);
            add_quad(sheet, {2, 0.5, 1}, {2, 0.5, 3}, {2, 2, 3}, {2, 2, 1}, 2, 2, clay);
            add(scene, sheet, turned);
            CHECK(find_orientation(scene).faces == 0);
        }
    }
    SECTION("a lamp alone") {
        Scene scene = empty_scene();
        add_lamp(scene, 0, 0, 0, 1, true);
        CHECK(find_orientation(scene).faces == 0);
    }
    SECTION("a dark room beside a lit one") {
        for (const bool turned : {false, true}) {
            Scene scene = furnished_room();
            add(scene, room({4.2, 0, 0}, {8, 3, 4}), turned);
            CHECK(find_orientation(scene).faces == 0);
        }
    }
    SECTION("a wall with a face for each of its sides") {
        Scene scene = furnished_room();
        add_quad(scene, {3, 0, 1}, {3, 0, 3}, {3, 2, 3}, {3, 2, 1}, 1, 1, wall);
        add_quad(scene, {3, 0, 1}, {3, 2, 1}, {3, 2, 3}, {3, 0, 3}, 1, 1, clay);
        CHECK(find_orientation(scene).faces == 0);
    }
    SECTION("nothing emits") {
        Scene scene = room({0, 0, 0}, {1, 1, 1});
        Faces one(scene.faces);
        one[3] = true;
        const Orientation found = find_orientation(with_turned(scene, one));
        CHECK(found.faces == 0);
        CHECK(found.clashing_edges == 4);
    }
    SECTION("no facet") { CHECK(find_orientation(empty_scene()).faces == 0); }
}

TEST_CASE("A Moebius strip has no sides and is left alone") {
    constexpr int n = 40;
    Scene scene = room({-2, -2, -2}, {2, 2, 2});
    add_lamp(scene, 0, 1.9, 0, 0.5, false);
    const auto first = scene.faces;
    const auto at = [&](int k, double across) {
        const double angle = 2 * std::numbers::pi * k / n, twist = angle / 2;
        const double r = 1 + across * std::cos(twist);
        return Vec3(r * std::cos(angle), across * std::sin(twist), r * std::sin(angle));
    };
    const auto base = static_cast<std::uint32_t>(scene.vertices.size());
    for (int k = 0; k < n; ++k)
        for (const double across : {-0.2, 0.2})
            scene.vertices.push_back(at(k, across));
    for (std::uint32_t k = 0; k < n; ++k) {
        const std::uint32_t a = base + 2 * k, b = a + 1;
        const std::uint32_t c = k + 1 < n ? a + 2 : base + 1, d = k + 1 < n ? b + 2 : base;
        scene.facets.push_back({{a, b, d, d}, scene.faces, clay, 0});
        scene.facets.push_back({{a, d, c, c}, scene.faces++, clay, 0});
    }
    Orientation found = find_orientation(scene);
    CHECK(found.one_sided == 1);
    CHECK(found.faces == 0);
    found = find_orientation(with_turned(scene, random_half(scene, 7)));
    CHECK(found.one_sided == 1);
    CHECK(std::none_of(found.looks_away.begin() + first, found.looks_away.end(),
                       [](bool away) { return away; }));
}

TEST_CASE("Junk does not crash: facets that share edges and vertices at random") {
    Rng rng(3);
    Scene scene = empty_scene();
    for (int k = 0; k < 40; ++k)
        scene.vertices.emplace_back(rng.uniform(), rng.uniform(), rng.uniform());
    const auto any = [&] { return static_cast<std::uint32_t>(rng.bits() % 40); };
    while (scene.faces < 600) {
        const std::uint32_t a = any(), b = any(), c = any();
        if (a == b || b == c || a == c)
            continue;
        scene.facets.push_back({{a, b, c, c}, scene.faces++, any() % 8 == 0 ? lamp : wall, 0});
    }
    CHECK(find_orientation(scene).looks_away == find_orientation(scene).looks_away);
}

TEST_CASE("A hundred thousand facets are gathered into shells at once", "[slow]") {
    Scene scene = room({-1, -1, -1}, {1, 1, 1});
    add(scene, box_room(Vec3(-.5), Vec3(.5), 130, materials, all_clay), true);
    add_lamp(scene, 0, 0.95, 0, 0.3, false);
    REQUIRE(scene.facets.size() > 100'000);
    CHECK(find_shells(scene).all.size() == 3);
    CHECK(find_orientation(scene).faces == 0);
    CHECK(find_orientation(with_turned(scene, all_faces(scene))).faces == scene.faces);
}
