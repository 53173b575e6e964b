// Ambient occlusion of texels: 1 minus view factors that are known in closed form.
#include "parallel/workers.h"
#include "radiosity/answers/charts/charts.h"
#include "radiosity/answers/lightmaps/occlusion_gather.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace hemilux;
using namespace hemilux::test;

namespace {

constexpr int size = 48;

/// A floor from -2 to 2 in x and z that fills the lightmap, with what `add` adds to it.
template <class Add>
Scene floor_with(const Add& add) {
    Scene scene;
    scene.groups = {"all"};
    scene.materials = {{"a", Vec3(.5), Vec3(0)}};
    add_quad(scene, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}, 1, 1, 0);
    add(scene);
    return scene;
}

std::vector<PlacedTriangle> floor_placed(const Mesh& mesh) {
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

Vec3 place_of(const Mesh& mesh, const TexelMap& texels, std::size_t texel) {
    return mesh.frame().to_world(texels.point(texel).position);
}

Occlusion occlusion_of(const Model& model, const TexelMap& texels,
                       const OcclusionOptions& options) {
    return gather_occlusion(model.mesh, model.bvh, texels, std::vector<bool>(texels.count()),
                            options, Workers(2));
}

/// The view factor from a point of the floor to a wall that stands on it, `distance` away, from its
/// foot to a height, and from the point's foot to one side (Siegel and Howell, configuration of an
/// element and a rectangle at right angles, the corner at its foot).
double factor_to_wall(double distance, double height, double width) {
    const double slant = std::hypot(distance, height);
    const double part = std::atan(width / distance) - distance / slant * std::atan(width / slant);
    return part / (2 * std::numbers::pi);
}

} // namespace

TEST_CASE("the occlusion beside a wall is the view factor to it, within the reported error") {
    const Model model(floor_with([](Scene& scene) {
        add_quad(scene, {2, 0, -2}, {2, 0, 2}, {2, 1, 2}, {2, 1, -2}, 1, 1, 0);
    }));
    const TexelMap texels(model.mesh, floor_placed(model.mesh), size);
    const Occlusion found = occlusion_of(model, texels, {.error = .002});
    double squares = 0, most = 0;
    for (std::size_t k = 0; k < texels.count(); ++k) {
        REQUIRE(found.lightmap.known[k]);
        const Vec3 at = place_of(model.mesh, texels, k);
        const double truth =
            1 - factor_to_wall(2 - at.x, 1, 2 - at.z) - factor_to_wall(2 - at.x, 1, 2 + at.z);
        const double off = found.lightmap.image.pixels[k].x - truth;
        squares += off * off;
        most = std::max(most, std::abs(off));
    }
    const double error = std::sqrt(squares / double(texels.count()));
    CAPTURE(error, most, found.all().error, found.all().bound);
    REQUIRE(found.objects.size() == 1);
    CHECK(found.objects[0].texels == texels.count());
    CHECK(found.all().bound <= .002);
    CHECK(error < 1.1 * found.all().bound);
    CHECK(error > .5 * found.all().error); // the estimate is no mere upper bound
    CHECK(most < .03);
    CHECK(found.rays >= texels.count() * 64);
}

TEST_CASE("nothing is blocked on an open plane, and all within a closed box") {
    const Model open(floor_with([](Scene&) {}));
    const TexelMap on_plane(open.mesh, floor_placed(open.mesh), size);
    const Occlusion free = occlusion_of(open, on_plane, {});
    for (const glm::vec3& texel : free.lightmap.image.pixels)
        REQUIRE(texel == glm::vec3(1));
    CHECK(free.all().error > 0); // what no ray has met may yet be there
    CHECK(free.all().error < 1e-3);

    const Model box(box_room({0, 0, 0}, {3, 2, 5}, 1, {{"a", Vec3(.5), Vec3(0)}}, {}));
    const TexelMap within(box.mesh, placed_triangles(box.mesh, find_charts(box.mesh, size)), size);
    const Occlusion blocked = occlusion_of(box, within, {});
    std::size_t shown = 0;
    for (std::size_t k = 0; k < within.count(); ++k) {
        shown += within.shows(k);
        REQUIRE(blocked.lightmap.image.pixels[k] == glm::vec3(0));
    }
    CHECK(shown > 500);
}

TEST_CASE("nothing beyond the distance blocks, and each object has rays enough for itself") {
    // A ceiling 1 m above the floor, with a small block of its own group on the floor.
    Scene scene = floor_with([](Scene& floor) {
        add_quad(floor, {-2, 1, -2}, {2, 1, -2}, {2, 1, 2}, {-2, 1, 2}, 1, 1, 0);
    });
    const Model model(scene);
    const TexelMap texels(model.mesh, floor_placed(model.mesh), size);
    const double metre = model.mesh.frame().scale;
    const auto at_distance = [&](double distance) {
        const Occlusion found =
            occlusion_of(model, texels, {.distance = distance * metre, .error = .005});
        return found.lightmap.image.at(size / 2, size / 2).x;
    };
    CHECK(at_distance(.99) == 1);
    // Of a wide ceiling the part within a distance is a disc, of view factor 1 - (h / d)^2.
    CHECK(at_distance(1.25) == Approx(.64).margin(.03));
    CHECK(at_distance(std::sqrt(2.0)) == Approx(.5).margin(.03));

    scene.groups = {"floor", "ceiling"};
    scene.facets[1].group = 1;
    const Model two(scene);
    std::vector<PlacedTriangle> placed = floor_placed(two.mesh);
    for (PlacedTriangle& triangle : placed)
        for (Vec2& place : triangle.place)
            place.x /= 2;
    for (const bool second : {false, true})
        placed.push_back({1,
                          false,
                          second,
                          1,
                          {Vec2(25, 1), second ? Vec2(30, 6) : Vec2(30, 1),
                           second ? Vec2(25, 6) : Vec2(30, 6)}});
    const TexelMap both(two.mesh, placed, size);
    const Occlusion found = occlusion_of(two, both, {.error = .01});
    REQUIRE(found.objects.size() == 2);
    for (const ObjectError& object : found.objects) {
        CHECK(object.bound <= .01);
        CHECK(object.error <= object.bound);
    }
    // The same bytes for any number of threads.
    const Occlusion again = gather_occlusion(
        two.mesh, two.bvh, both, std::vector<bool>(both.count()), {.error = .01}, Workers(1));
    CHECK(again.lightmap.image.pixels == found.lightmap.image.pixels);
}
