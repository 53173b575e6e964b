#include "bvh/wide/wide_bvh.h"
#include "radiosity/answers/views/automatic_camera.h"
#include "radiosity/answers/views/camera_rays.h"
#include "radiosity/light/lamps/emitter_shapes.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/catch.h"
#include "support/scenes.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <numbers>

using namespace hemilux;
using namespace hemilux::test;

namespace {

constexpr std::uint32_t left_out = 1;

/// A box without the sides of material `left_out`, sides as in box_room, and with a block inside.
Mesh box_without(const std::array<std::uint32_t, 6>& sides, bool two_sided = false) {
    Scene scene = box_room({10, 0, 0}, {14, 3, 5}, 4,
                           {{"wall", Vec3(0.5), Vec3(0)}, {"none", Vec3(0.5), Vec3(0)}}, sides);
    std::erase_if(scene.facets, [](const Facet& facet) { return facet.material == left_out; });
    add_quad(scene, {11, 1, 2}, {11, 1, 3}, {12, 1, 3}, {12, 1, 2}, 1, 1, 0);
    add_quad(scene, {11, 0, 3}, {12, 0, 3}, {12, 1, 3}, {11, 1, 3}, 1, 1, 0);
    add_quad(scene, {12, 0, 3}, {12, 0, 2}, {12, 1, 2}, {12, 1, 3}, 1, 1, 0);
    return Mesh(std::move(scene), {.two_sided = two_sided});
}

/// What share of a camera's picture shows a surface, and what share shows one through backs.
struct Shares {
    double seen = 0, through_backs = 0;
};
Shares shares_of(const Mesh& mesh, const Tracer& tracer, const Camera& camera) {
    const CameraRays rays(camera, mesh, 4.0 / 3);
    Shares shares;
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 40; ++x)
            if (const auto seen = look(mesh, tracer, rays.ray((x + 0.5) / 40, (y + 0.5) / 30))) {
                shares.seen += 1.0 / 1200;
                shares.through_backs += (seen->backs > 0) / 1200.0;
            }
    return shares;
}

std::vector<Vec3> even_light(const Mesh& mesh) {
    return std::vector<Vec3>(mesh.patches().size(), Vec3(1));
}

} // namespace

TEST_CASE("rays span the angle, right is right and up is up") {
    const Mesh mesh = box_without({});
    const Camera camera{.eye = {12, 1, 9}, .target = {12, 1, 0}, .vertical_fov_degrees = 60};
    const CameraRays rays(camera, mesh, 2);
    CHECK(mesh.frame().to_world(rays.ray(0, 0).origin) == camera.eye);
    CHECK(glm::distance(rays.ray(0.5, 0.5).direction, Vec3(0, 0, -1)) < 1e-12);
    const Vec3 top = rays.ray(0.5, 0).direction, right = rays.ray(1, 0.5).direction;
    CHECK(top.y / -top.z == Approx(std::tan(std::numbers::pi / 6)));
    CHECK(right.x / -right.z == Approx(2 * std::tan(std::numbers::pi / 6)));
}

TEST_CASE("a camera that looks straight down has rays") {
    const Mesh mesh = box_without({});
    const CameraRays rays({.eye = {12, 2, 2}, .target = {12, 0, 2}}, mesh, 1);
    CHECK(glm::distance(rays.ray(0.5, 0.5).direction, Vec3(0, -1, 0)) < 1e-12);
    CHECK(std::isfinite(rays.ray(0, 0).direction.x));
}

TEST_CASE("a picture looks through the backs of one-sided facets only") {
    const Camera outside{.eye = {12, 1.5, 20}, .target = {12, 1.5, 2}, .vertical_fov_degrees = 5};
    for (const bool two_sided : {false, true}) {
        const Mesh mesh = box_without({}, two_sided);
        const WideBvh bvh(mesh.soup());
        const CameraRays rays(outside, mesh, 1);
        const auto seen = look(mesh, bvh, rays.ray(0.47, 0.46));
        REQUIRE(seen);
        const Vec3 at = mesh.frame().to_world(mesh.patches()[seen->patch].centre);
        CHECK(at.z == Approx(two_sided ? 5 : 0).margin(1e-9));
        CHECK(seen->backs == (two_sided ? 0 : 1));
    }
}

TEST_CASE("a front on the very place of a back is seen") {
    for (const bool back_first : {false, true}) {
        Scene scene;
        scene.materials = {{"a", Vec3(0.5), Vec3(0)}};
        scene.groups = {"all"};
        const Vec3 a(0, 0, 0), b(1, 0, 0), c(1, 1, 0), d(0, 1, 0);
        for (const bool back : {back_first, !back_first})
            back ? add_quad(scene, a, d, c, b, 1, 1, 0) : add_quad(scene, a, b, c, d, 1, 1, 0);
        const Mesh mesh(std::move(scene));
        const WideBvh bvh(mesh.soup());
        const auto seen = look(mesh, bvh, {.origin = {0.1, 0.2, 1}, .direction = {0, 0, -1}});
        REQUIRE(seen);
        CHECK(mesh.patches()[seen->patch].normal.z == Approx(1));
    }
}

TEST_CASE("the automatic camera looks into an open box through its opening") {
    // Openings at -x, +x, -z, +z.
    for (const std::size_t side : {2u, 3u, 4u, 5u}) {
        std::array<std::uint32_t, 6> sides{};
        sides[side] = left_out;
        const Mesh mesh = box_without(sides);
        const WideBvh bvh(mesh.soup());
        const Camera camera = automatic_camera(mesh, bvh, even_light(mesh));
        INFO("open side " << side);
        const std::size_t axis = side < 4 ? 0 : 2;
        const Vec3 from_centre = camera.eye - Vec3(12, 1.5, 2.5);
        const double out = from_centre[static_cast<int>(axis)] * (side % 2 == 0 ? -1 : 1);
        CHECK(out > 0);
        const Shares shares = shares_of(mesh, bvh, camera);
        CHECK(shares.seen > 0.6);
        CHECK(shares.through_backs < 0.05);
    }
}

TEST_CASE("the automatic camera fills its picture with a closed room") {
    for (const bool two_sided : {false, true}) {
        const Mesh mesh = box_without({}, two_sided);
        const WideBvh bvh(mesh.soup());
        const Camera camera = automatic_camera(mesh, bvh, even_light(mesh));
        const Shares shares = shares_of(mesh, bvh, camera);
        CHECK(shares.seen > 0.99);
        CHECK(shares.through_backs < 0.01);
        CHECK(glm::distance(camera.eye, Vec3(12, 1.5, 2.5)) < 4);
    }
}

TEST_CASE("the automatic camera sees an object from outside, and a single facet from its front") {
    Scene scene;
    scene.materials = {{"a", Vec3(0.5), Vec3(0)}};
    scene.groups = {"all"};
    add_quad(scene, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 1, 1, 0);
    const Mesh sheet(std::move(scene));
    const WideBvh sheet_bvh(sheet.soup());
    const Camera camera = automatic_camera(sheet, sheet_bvh, even_light(sheet));
    CHECK(camera.eye.z > 0);
    CHECK(shares_of(sheet, sheet_bvh, camera).seen > 0.3);

    const Mesh open(open_scene());
    const WideBvh open_bvh(open.soup());
    CHECK(shares_of(open, open_bvh, automatic_camera(open, open_bvh, even_light(open))).seen > 0.2);
}

TEST_CASE("the automatic camera stands upright where z is up") {
    Scene scene = room_with_block();
    for (Vec3& v : scene.vertices)
        v = {v.z, v.x, v.y};
    const Mesh z_up(std::move(scene)), y_up(room_with_block());
    CHECK(automatic_camera(z_up, WideBvh(z_up.soup()), even_light(z_up)).up == Vec3(0, 0, 1));
    CHECK(automatic_camera(y_up, WideBvh(y_up.soup()), even_light(y_up)).up == Vec3(0, 1, 0));
    CHECK(automatic_camera(y_up, WideBvh(y_up.soup()), even_light(y_up), 1.5, 2).up ==
          Vec3(0, 0, 1));
    CHECK(guess_up(z_up) == 2);
    CHECK(guess_up(y_up) == 1);
}

TEST_CASE("the automatic camera is always the same, in the dark too") {
    const Mesh mesh = box_without({});
    const WideBvh bvh(mesh.soup());
    const std::vector<Vec3> dark(mesh.patches().size(), Vec3(0));
    const Camera a = automatic_camera(mesh, bvh, dark), b = automatic_camera(mesh, bvh, dark);
    CHECK(a.eye == b.eye);
    CHECK(a.target == b.target);
    CHECK(shares_of(mesh, bvh, a).seen > 0.99);
}

TEST_CASE("An object under the sky is looked at from outside, and all of it is seen") {
    Scene scene;
    scene.materials = {{"leg", Vec3(0.5), Vec3(0)}};
    scene.groups = {"table"};
    add_block(scene, {0, 0.9, 0}, {2, 1, 1});
    for (const double x : {0.0, 1.9})
        for (const double z : {0.0, 0.9})
            add_block(scene, {x, 0, z}, {x + 0.1, 0.9, z + 0.1});
    const Box bounds = bounds_of(scene);
    add_sky(scene, "sky", bounds, Vec3(1));
    const Mesh mesh(std::move(scene));
    const WideBvh bvh(mesh.soup());
    const Camera camera = automatic_camera(mesh, bvh, even_light(mesh));
    CHECK((glm::any(glm::lessThan(camera.eye, bounds.low)) ||
           glm::any(glm::lessThan(bounds.high, camera.eye))));
    const double cosine = std::cos(glm::radians(camera.vertical_fov_degrees) * 5 / 6);
    for (const Vec3& corner : {bounds.low, bounds.high})
        CHECK(glm::dot(glm::normalize(corner - camera.eye),
                       glm::normalize(camera.target - camera.eye)) > cosine);
}
