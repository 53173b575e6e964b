// The light that is chosen for scenes without one, and whether light reaches what can be looked at,
// on families of scenes of any size, with y or z upwards.
#include "radiosity/engine/needs/find_needs.h"
#include "radiosity/engine/rays/make_tracer.h"
#include "radiosity/engine/rays/point_emitter.h"
#include "radiosity/light/rooms/default_light.h"
#include "radiosity/light/rooms/reached_places.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/catch.h"
#include "support/scenes.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace hemilux;
using namespace hemilux::test;

namespace {

/// How a family is placed in the world.
struct Placing {
    std::string name;
    double unit;
    int up;
    Vec3 origin{0.0};
};

const std::vector<Placing> placings{{"metres, y", 1, 1},
                                    {"metres, z", 1, 2},
                                    {"millimetres, y", 1000, 1, {4e5, 0, -7e5}},
                                    {"tiny, z", 1e-6, 2}};

/// Places a scene that was made in metres with y upwards.
Scene placed(Scene scene, const Placing& placing) {
    for (Vec3& v : scene.vertices) {
        const Vec3 turned = placing.up == 1 ? v : Vec3(v.z, v.x, v.y); // keeps the fronts
        v = placing.origin + placing.unit * turned;
    }
    return scene;
}

struct Looked {
    explicit Looked(const Scene& scene)
        : mesh(scene), made(make_tracer(mesh)), free(find_free_space(mesh, *made.tracer)) {}
    [[nodiscard]] DefaultLight light(int up) const {
        return choose_default_light(mesh, *made.tracer, free, up);
    }
    [[nodiscard]] double reached() const { return share_of_lit_spaces(mesh, *made.tracer, free); }

    Mesh mesh;
    MadeTracer made;
    FreeSpace free;
};

const std::vector<Material> paint{{.name = "white", .reflectance = Vec3(0.7)},
                                  {.name = "lamp", .reflectance = Vec3(0), .emission = Vec3(5)}};

Scene room(const Vec3& low, const Vec3& high) {
    return box_room(low, high, 1, paint, {0, 0, 0, 0, 0, 0});
}

/// Rooms beside each other, with walls between them that light does not pass.
Scene rooms(int count) {
    Scene scene = room({0, 0, 0}, {4, 2.5, 5});
    for (int k = 1; k < count; ++k)
        add_scene(scene, room({4.2 * k, 0, 0}, {4.2 * k + 4, 2.5, 5}));
    return scene;
}

/// A case with inner walls, which stands on the floor; a lamp fills its inner ceiling.
Scene case_with_lamp(const Vec3& low, const Vec3& high, double emission) {
    std::vector<Material> materials = paint;
    materials[1].emission = Vec3(emission);
    Scene scene = box_room(low + 0.02, high - 0.02, 1, materials, {0, 1, 0, 0, 0, 0});
    add_block(scene, low, high);
    return scene;
}

/// A floor, a roof on four posts.
Scene pavilion() {
    Scene scene;
    scene.materials = paint;
    scene.groups = {"all"};
    add_block(scene, {-3, -0.2, -3}, {3, 0, 3});
    add_block(scene, {-3, 3, -3}, {3, 3.2, 3});
    for (const double x : {-2.5, 2.3})
        for (const double z : {-2.5, 2.3})
            add_block(scene, {x, 0, z}, {x + 0.2, 3, z + 0.2});
    return scene;
}

Scene thing() {
    Scene scene;
    scene.materials = paint;
    scene.groups = {"all"};
    add_block(scene, {0, 0, 0}, {0.4, 0.6, 0.3});
    return scene;
}

bool is_within(const Vec3& p, const Vec3& low, const Vec3& high) {
    return glm::all(glm::lessThan(low, p)) && glm::all(glm::lessThan(p, high));
}

} // namespace

TEST_CASE("A closed room gets one lamp under the middle of its ceiling, and no daylight") {
    for (const Placing& placing : placings) {
        CAPTURE(placing.name);
        const Looked looked(placed(room({0, 0, 0}, {4, 2.5, 5}), placing));
        const DefaultLight light = looked.light(placing.up);
        CHECK_FALSE(light.sky);
        REQUIRE(light.lamps.size() == 1);
        const RoomLamp& lamp = light.lamps.front();
        const Vec3 place =
            (looked.mesh.frame().to_world(lamp.centre) - placing.origin) / placing.unit;
        const double height = place[placing.up];
        CHECK((height > 2.2 && height < 2.5));
        const double radius = lamp.radius / looked.mesh.frame().scale / placing.unit;
        CHECK((radius > 0.1 && radius < 0.6));
        // Its surfaces have an area of 85 m2.
        const double area =
            looked.mesh.frame().area_to_world(lamp.area) / placing.unit / placing.unit;
        CHECK((area > 50 && area < 150));
        const Vec3 low = placing.up == 1 ? Vec3(1, 0, 1) : Vec3(1, 1, 0);
        const Vec3 high = placing.up == 1 ? Vec3(3, 3, 4) : Vec3(4, 3, 3);
        CHECK(is_within(place, low, high));
    }
}

TEST_CASE("Each room gets a lamp") {
    for (const Placing& placing : placings)
        for (const int count : {2, 3, 6}) {
            CAPTURE(placing.name, count);
            const Looked looked(placed(rooms(count), placing));
            const DefaultLight light = looked.light(placing.up);
            CHECK(light.lamps.size() == std::size_t(count));
            CHECK_FALSE(light.sky);
        }
}

TEST_CASE("An open pavilion and a thing get a sky and a sun from above") {
    for (const Placing& placing : placings)
        for (const Scene& scene : {pavilion(), thing()}) {
            CAPTURE(placing.name, scene.facets.size());
            const Looked looked(placed(scene, placing));
            const DefaultLight light = looked.light(placing.up);
            CHECK(light.sky);
            CHECK(light.lamps.empty());
            CHECK(light.sun[placing.up] < 0);
        }
}

TEST_CASE("A house of rooms under the sky gets daylight, and lamps where somebody looks inside") {
    Scene scene = rooms(2);
    add_block(scene, {-0.2, -0.2, -0.2}, {8.4, 2.7, 5.2});
    add_block(scene, {-9, -0.3, -9}, {18, -0.2, 14}); // its garden
    add_block(scene, {15, -0.2, 10}, {16, 6, 11});    // and a tower in it
    const Looked looked(scene);
    const DefaultLight light = looked.light(1);
    CHECK(light.sky);
    CHECK(light.lamps.empty());
    const DefaultLight inside =
        choose_default_light(looked.mesh, *looked.made.tracer, looked.free, 1, true);
    CHECK(inside.sky);
    CHECK(inside.lamps.size() == 2);
}

TEST_CASE("Light that stays within a case does not reach what can be looked at") {
    for (const Placing& placing : placings) {
        CAPTURE(placing.name);
        Scene scene = room({0, 0, 0}, {4, 2.5, 5});
        CHECK(Looked(placed(scene, placing)).reached() == 0);
        add_scene(scene, case_with_lamp({1, 0, 1}, {1.3, 0.5, 1.5}, 1e6));
        const Looked looked(placed(scene, placing));
        CHECK(looked.reached() < 0.02);
        CHECK(looked.light(placing.up).lamps.size() == 1);
    }
}

TEST_CASE("A lamp in the room reaches it, however faint or small it is") {
    for (const Placing& placing : placings)
        for (const double emission : {1e-9, 5.0, 1e9}) {
            CAPTURE(placing.name, emission);
            std::vector<Material> materials = paint;
            materials[1].emission = Vec3(emission);
            Scene scene = room({0, 0, 0}, {4, 2.5, 5});
            scene.materials = materials;
            const auto first = std::uint32_t(scene.vertices.size());
            for (const Vec3& corner :
                 {Vec3(2, 2.4, 2), Vec3(2, 2.4, 2.01), Vec3(1.99, 2.4, 2.01), Vec3(1.99, 2.4, 2)})
                scene.vertices.push_back(corner);
            scene.facets.push_back({.vertex = {first, first + 3, first + 2, first + 1},
                                    .face = scene.faces++,
                                    .material = 1,
                                    .group = 0});
            std::reverse(scene.facets.back().vertex.begin(), scene.facets.back().vertex.end());
            const double one = Looked(placed(scene, placing)).reached();
            std::reverse(scene.facets.back().vertex.begin(), scene.facets.back().vertex.end());
            const double other = Looked(placed(scene, placing)).reached();
            CHECK(std::max(one, other) > 0.9); // one of them shines downwards
        }
}

TEST_CASE("One lit room of several counts as much as its size") {
    for (const int count : {2, 4}) {
        Scene scene = box_room({-4.2, 0, 0}, {-0.2, 2.5, 5}, 1, paint, {0, 1, 0, 0, 0, 0});
        add_scene(scene, rooms(count - 1));
        CHECK(Looked(scene).reached() == Approx(1.0 / count).margin(0.05));
    }
}

TEST_CASE("A spot that lights little of a wide floor lights its space") {
    Scene scene;
    scene.materials = paint;
    scene.groups = {"all"};
    add_block(scene, {-5, -0.1, -5}, {5, 0, 5});
    add_point_emitter(scene, {.name = "spot",
                              .position = {0, 2, 0},
                              .axis = {0, -1, 0},
                              .intensity = Vec3(1),
                              .cos_inner = std::cos(0.39),
                              .cos_outer = std::cos(0.4)});
    CHECK(Looked(scene).reached() > 0.9);
}

TEST_CASE("The same scene gets the same light") {
    const Looked one(rooms(3)), other(rooms(3));
    const DefaultLight a = one.light(1), b = other.light(1);
    REQUIRE(a.lamps.size() == b.lamps.size());
    for (std::size_t k = 0; k < a.lamps.size(); ++k)
        CHECK(a.lamps[k].centre == b.lamps[k].centre);
    CHECK(one.reached() == other.reached());
}
