// Pictures whose light is gathered at their pixels, against light in closed form.
#include "bvh/wide/wide_bvh.h"
#include "parallel/asked_to_end.h"
#include "radiosity/answers/pictures/render.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/catch.h"
#include "support/closed_forms.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace hemilux;
using test::Model;
using test::point_to_polygon;

namespace {

constexpr int width = 96, height = 48;
constexpr double lamp_emission = 20;

/// Sees the ground from x = -2 to 2 and z = -1 to 1 from above.
const Camera from_above{.eye = {0, 5, 0},
                        .target = {0, 0, 0},
                        .up = {0, 0, -1},
                        .vertical_fov_degrees = 22.619864948040426};

/// Ground of 4 x 2 m, of one patch, and a lamp of 0.2 x 0.2 m that hangs 1 m above x = 1.
Scene lamp_over_ground() {
    Scene scene;
    scene.materials = {{"ground", Vec3(.5, .25, 0), Vec3(0)},
                       {"lamp", Vec3(0), Vec3(lamp_emission)},
                       {"black", Vec3(0), Vec3(0)}};
    scene.groups = {"default"};
    test::add_quad(scene, {-2, 0, -1}, {-2, 0, 1}, {2, 0, 1}, {2, 0, -1}, 1, 1, 0);
    test::add_quad(scene, {.9, 1, -.1}, {1.1, 1, -.1}, {1.1, 1, .1}, {.9, 1, .1}, 1, 1, 1);
    scene.faces = 2;
    return scene;
}

/// A black wall of no thickness across x = 0, as high as the lamp and higher.
void add_wall(Scene& scene) {
    test::add_quad(scene, {0, 0, -1}, {0, 2, -1}, {0, 2, 1}, {0, 0, 1}, 1, 1, 2);
    test::add_quad(scene, {0, 0, 1}, {0, 2, 1}, {0, 2, -1}, {0, 0, -1}, 1, 1, 2);
    scene.faces += 2;
}

Image picture_of(const Model& model, const Camera& camera, RenderOptions options = {}) {
    const Solution solution =
        test::solve(model, *find_method("stored-transport"), {}, test::steps(2));
    options.width = width;
    options.height = height;
    options.gather = options.gather > 0 ? options.gather : 16;
    return render(model.mesh, model.bvh, solution.radiosity, camera, options);
}

/// Of the centre of a pixel on the ground.
Vec3 ground_at(int x, int y) { return {-2 + 4 * (x + .5) / width, 0, -1 + 2 * (y + .5) / height}; }

/// Of the centre of a pixel of any camera, on the plane of the ground; local frame.
Vec3 ground_at(const Model& model, const Camera& camera, int x, int y) {
    const Ray ray = CameraRays(camera, model.mesh, double(width) / height)
                        .ray((x + .5) / width, (y + .5) / height);
    const double down = model.mesh.frame().to_local(Vec3(0)).y - ray.origin.y;
    return ray.origin + down / ray.direction.y * ray.direction;
}

} // namespace

TEST_CASE("gathered light below a lamp is Lambert's, on a ground of one patch") {
    const Model model(lamp_over_ground());
    const Image image = picture_of(model, from_above);
    Polygon lamp = model.mesh.whole_side(1, false).shape;
    double square = 0, size = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width / 2; ++x) { // the lamp's back hides some of the right half
            const double light =
                lamp_emission *
                point_to_polygon(model.mesh.frame().to_local(ground_at(x, y)), {0, 1, 0}, lamp);
            const glm::vec3& pixel = image.at(x, y);
            CHECK(pixel.x == Approx(.5 * light).epsilon(.15));
            CHECK(pixel.y == Approx(.5 * pixel.x).epsilon(1e-5));
            CHECK(pixel.z == 0);
            square += std::pow(pixel.x - .5 * light, 2);
            size += std::pow(.5 * light, 2);
        }
    CHECK(std::sqrt(square / size) < .03);
}

TEST_CASE("light that few rays find, as that of a sky through a hole, gets more of them") {
    // Below a black lid at a height of 1 m with a hole of 0.5 x 0.5 m, above which all is bright.
    Scene scene;
    scene.materials = {{"ground", Vec3(.5), Vec3(0)},
                       {"sky", Vec3(0), Vec3(lamp_emission), true},
                       {"black", Vec3(0), Vec3(0)}};
    scene.groups = {"default"};
    test::add_quad(scene, {-2, 0, -1}, {-2, 0, 1}, {2, 0, 1}, {2, 0, -1}, 1, 1, 0);
    test::add_quad(scene, {-900, 9, -900}, {900, 9, -900}, {900, 9, 900}, {-900, 9, 900}, 1, 1, 1);
    constexpr double wide = 40, hole = .25;
    for (const auto& [low, high] : {std::pair(Vec2(-wide), Vec2(wide, -hole)),
                                    {Vec2(-wide, hole), Vec2(wide)},
                                    {Vec2(-wide, -hole), Vec2(-hole, hole)},
                                    {Vec2(hole, -hole), Vec2(wide, hole)}})
        test::add_quad(scene, {low.x, 1, low.y}, {high.x, 1, low.y}, {high.x, 1, high.y},
                       {low.x, 1, high.y}, 1, 1, 2);
    scene.faces = 6;
    const Model model(std::move(scene));
    Camera below_lid = from_above;
    below_lid.eye.y = .98;
    below_lid.vertical_fov_degrees = 2 * std::atan(1 / .98) * 180 / std::numbers::pi;
    const Image image = picture_of(model, below_lid);
    const LocalFrame& frame = model.mesh.frame();
    Polygon opening;
    opening.corner = {Vec3(-hole, 1, -hole), {hole, 1, -hole}, {hole, 1, hole}, {-hole, 1, hole}};
    for (Vec3& corner : opening.corner)
        corner = frame.to_local(corner);
    double square = 0, size = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double light =
                .5 * lamp_emission *
                point_to_polygon(frame.to_local(ground_at(x, y)), {0, 1, 0}, opening);
            square += std::pow(image.at(x, y).x - light, 2);
            size += std::pow(light, 2);
        }
    CHECK(std::sqrt(square / size) < .12);
}

TEST_CASE("no light leaks below a wall, however thin, neither straight nor by reflection") {
    Scene scene = lamp_over_ground();
    add_wall(scene);
    test::add_quad(scene, {1.9, 0, -1}, {1.9, 0, 1}, {1.9, 1.5, 1}, {1.9, 1.5, -1}, 1, 1, 0);
    ++scene.faces;
    const Model model(std::move(scene));
    for (const unsigned rays : {4u, 64u}) {
        RenderOptions options;
        options.gather = rays;
        const Image image = picture_of(model, from_above, options);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width / 2 - 1; ++x)
                CHECK(image.at(x, y).x == 0);
            CHECK(image.at(width / 2 + 1, y).x > 0);
        }
    }
}

TEST_CASE("the shadow of a thin thing is found") {
    Scene scene = lamp_over_ground();
    // Half as high as the lamp, and a fifth as wide: it hides .4 of the lamp from below its middle.
    test::add_quad(scene, {.98, .5, -1}, {1.02, .5, -1}, {1.02, .5, 1}, {.98, .5, 1}, 1, 1, 2);
    test::add_quad(scene, {1.02, .5, -1}, {.98, .5, -1}, {.98, .5, 1}, {1.02, .5, 1}, 1, 1, 2);
    scene.faces += 2;
    const Model model(std::move(scene));
    Camera from_beside = from_above; // the ground where the shadow is stays in view
    from_beside.eye.x = -1;
    from_beside.target = {.5, 0, 0};
    const Image shaded = picture_of(model, from_beside),
                lit = picture_of(Model(lamp_over_ground()), from_beside);
    const double near = model.mesh.frame().to_local(Vec3(.9, 0, 0)).x,
                 far = model.mesh.frame().to_local(Vec3(1.1, 0, 0)).x;
    float darkest = 1;
    for (int x = 0; x < width; ++x)
        if (const double at = ground_at(model, from_beside, x, height / 2).x; at > near && at < far)
            darkest = std::min(darkest, shaded.at(x, height / 2).x / lit.at(x, height / 2).x);
    CHECK(darkest == Approx(.6).margin(.12));
}

TEST_CASE("a sharp shadow two pixels wide is dark, and what is beside it is lit") {
    // A post without thickness, two pixels wide: beside it the penumbra is far below a pixel.
    constexpr double half = 2.0 / height;
    Scene scene = lamp_over_ground();
    test::add_quad(scene, {0, 0, -half}, {0, .5, -half}, {0, .5, half}, {0, 0, half}, 1, 1, 2);
    test::add_quad(scene, {0, 0, half}, {0, .5, half}, {0, .5, -half}, {0, 0, -half}, 1, 1, 2);
    scene.faces += 2;
    const Image shaded = picture_of(Model(std::move(scene)), from_above),
                lit = picture_of(Model(lamp_over_ground()), from_above);
    for (int x = width / 2 - 2; x < width / 2; ++x)
        for (int y = height / 2 - 3; y < height / 2 + 3; ++y) {
            const bool dark = y == height / 2 - 1 || y == height / 2;
            const float share = shaded.at(x, y).x / lit.at(x, y).x;
            CAPTURE(x, y, share);
            CHECK((dark ? share < .1f : share > .85f));
        }
}

TEST_CASE("a strip narrower than a pixel is not dotted where a lamp is half hidden") {
    Scene scene;
    scene.materials = {{"strip", Vec3(.5), Vec3(0)},
                       {"lamp", Vec3(0), Vec3(lamp_emission)},
                       {"black", Vec3(0), Vec3(0)}};
    scene.groups = {"default"};
    constexpr double pixel = 4.0 / width, low = .25 * pixel, high = .65 * pixel;
    test::add_quad(scene, {-2, 0, low}, {-2, 0, high}, {2, 0, high}, {2, 0, low}, 1, 1, 0);
    test::add_quad(scene, {-.5, 1, -.5}, {.5, 1, -.5}, {.5, 1, .5}, {-.5, 1, .5}, 1, 1, 1);
    // Its edge is at x = 0, half way up: the lamp is partly hidden from x = -0.5 to 0.5.
    test::add_quad(scene, {0, .5, -2}, {2, .5, -2}, {2, .5, 2}, {0, .5, 2}, 1, 1, 2);
    scene.faces = 3;
    const Model model(std::move(scene));
    const Image few = picture_of(model, from_above),
                many = picture_of(model, from_above, {.gather = 1024});
    constexpr int row = height / 2, first = width / 2 - 10, last = width / 2 + 10;
    double square = 0, size = 0;
    for (int x = first; x < last; ++x) {
        REQUIRE(many.at(x, row).x > 0);
        square += std::pow(few.at(x, row).x - many.at(x, row).x, 2);
        size += std::pow(many.at(x, row).x, 2);
    }
    CAPTURE(std::sqrt(square / size));
    CHECK(std::sqrt(square / size) < .25);
}

TEST_CASE("gathered light rises up to the edge of a surface") {
    // A wall that shines stands along an edge of the ground, which runs askew through the picture.
    Scene scene = lamp_over_ground();
    scene.materials[1].emission = Vec3(0);
    scene.materials.push_back({"wall", Vec3(0), Vec3(1)});
    test::add_quad(scene, {-2, 0, 1}, {-2, 0, -1}, {-2, .5, -1}, {-2, .5, 1}, 1, 1, 3);
    scene.faces += 1;
    const Model model(std::move(scene));
    constexpr double askew = .3;
    Camera camera = from_above;
    camera.eye = {-1.5, 2, 0};
    camera.target = {-1.5, 0, 0};
    camera.up = {std::sin(askew), 0, -std::cos(askew)};
    const Image image = picture_of(model, camera);
    const Polygon wall = model.mesh.whole_side(2, false).shape;
    const double edge = model.mesh.frame().to_local(Vec3(-2, 0, 0)).x;
    const double pixel =
        glm::distance(ground_at(model, camera, 1, 0), ground_at(model, camera, 0, 0));
    double square = 0, size = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const Vec3 at = ground_at(model, camera, x, y);
            if (at.x < edge + pixel || at.x > edge + 4 * pixel)
                continue;
            const double light = .5 * point_to_polygon(at, {0, 1, 0}, wall);
            square += std::pow(image.at(x, y).x - light, 2);
            size += light * light;
        }
    CHECK(std::sqrt(square / size) < .006);
}

TEST_CASE("in a furnace every gathered pixel is the same") {
    const Model model(test::furnace_box(3, .5));
    const std::vector<Vec3> b(model.mesh.patches().size(), Vec3(2));
    const Camera camera = automatic_camera(model.mesh, model.bvh, b);
    const Image image = render(model.mesh, model.bvh, b, camera,
                               {.width = 40, .height = 30, .gather = GENERATE(1u, 5u, 16u)});
    for (const glm::vec3& pixel : image.pixels)
        REQUIRE(glm::distance(pixel, glm::vec3(2)) < 1e-5f);
}

TEST_CASE("more rays make a gathered picture less noisy", "[slow]") {
    const Model model(test::room_with_block());
    const Solution solution =
        test::solve(model, *find_method("stored-transport"), {}, test::steps(4));
    const Camera camera = automatic_camera(model.mesh, model.bvh, solution.radiosity);
    const auto picture = [&](unsigned rays) {
        return render(model.mesh, model.bvh, solution.radiosity, camera,
                      {.width = 64, .height = 48, .gather = rays});
    };
    const Image best = picture(1024), many = picture(64), few = picture(4);
    const auto distance = [&](const Image& image) {
        double sum = 0;
        for (std::size_t k = 0; k < image.pixels.size(); ++k)
            sum += std::pow(glm::distance(image.pixels[k], best.pixels[k]), 2);
        return std::sqrt(sum);
    };
    CHECK(distance(many) < .6 * distance(few));
}

TEST_CASE("a gathered picture does not depend on threads; beside all surfaces it is black") {
    const Model model(test::open_scene());
    const Solution solution =
        test::solve(model, *find_method("stored-transport"), {}, test::steps(2));
    const Camera camera = automatic_camera(model.mesh, model.bvh, solution.radiosity);
    const auto picture = [&](unsigned threads, unsigned gather) {
        return render(model.mesh, model.bvh, solution.radiosity, camera,
                      {.width = 70, .height = 50, .gather = gather, .threads = threads});
    };
    const Image one = picture(1, 8);
    CHECK(one.pixels == picture(3, 8).pixels);
    const Image interpolated = picture(1, 0);
    std::size_t black = 0;
    for (std::size_t k = 0; k < one.pixels.size(); ++k)
        if (interpolated.pixels[k] == glm::vec3(0.0f)) {
            ++black;
            CHECK(one.pixels[k] == glm::vec3(0.0f));
        }
    CHECK(black > 0);
}

TEST_CASE("both sides of a sheet have gathered light of their own") {
    Scene scene = lamp_over_ground();
    const Model model(std::move(scene), {.two_sided = true});
    Camera from_below = from_above;
    from_below.eye.y = -5;
    const Image above = picture_of(model, from_above), below = picture_of(model, from_below);
    CHECK(above.at(20, 20).x > 0);
    for (const glm::vec3& pixel : below.pixels)
        CHECK(pixel == glm::vec3(0.0f));
}

TEST_CASE("a gathered picture can be given up") {
    const Model model(test::room_with_block());
    const std::vector<Vec3> b(model.mesh.patches().size(), Vec3(1));
    const Camera camera = automatic_camera(model.mesh, model.bvh, b);
    int asked = 0;
    const RenderOptions options{
        .width = 64, .height = 64, .gather = 4, .threads = 1, .give_up = [&] {
            return ++asked > 12;
        }};
    CHECK_THROWS_AS(render(model.mesh, model.bvh, b, camera, options), Interrupted);
}
