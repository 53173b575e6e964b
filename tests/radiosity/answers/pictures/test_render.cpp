#include "bvh/wide/wide_bvh.h"
#include "radiosity/answers/pictures/render.h"
#include "radiosity/answers/vertices/smooth.h"
#include "radiosity/engine/rays/make_tracer.h"
#include "radiosity/engine/rays/panes.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/catch.h"
#include "support/scenes.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

using namespace hemilux;
using namespace hemilux::test;

namespace {

/// A wall of n x n patches over [0,1]^2, facing +z.
Mesh wall(std::uint32_t n) {
    Scene scene;
    scene.materials = {{"wall", Vec3(0.5), Vec3(0)}};
    scene.groups = {"all"};
    add_quad(scene, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, n, n, 0);
    return Mesh(std::move(scene));
}

/// Sees exactly the square [0,1]^2 of the plane z = 0.
const Camera square_camera{
    .eye = {0.5, 0.5, 1}, .target = {0.5, 0.5, 0}, .vertical_fov_degrees = 53.13010235415598};

} // namespace

TEST_CASE("in a furnace every pixel is the same") {
    const Mesh mesh(furnace_box(3, 0.5));
    const WideBvh bvh(mesh.soup());
    const std::vector<Vec3> b(mesh.patches().size(), {1, 2, 3});
    const Camera camera = automatic_camera(mesh, bvh, b);
    for (const bool smooth : {false, true}) {
        const Image image =
            render(mesh, bvh, b, camera, {.width = 40, .height = 30, .smooth = smooth});
        for (const glm::vec3& pixel : image.pixels)
            REQUIRE(glm::distance(pixel, glm::vec3(1, 2, 3)) < 1e-5f);
    }
}

TEST_CASE("without smoothing a pixel shows its patch") {
    const Mesh mesh = wall(4);
    const WideBvh bvh(mesh.soup());
    std::vector<Vec3> b;
    for (std::size_t i = 0; i < 16; ++i)
        b.emplace_back(static_cast<double>(i) + 1);
    const Image image = render(mesh, bvh, b, square_camera,
                               {.width = 4, .height = 4, .samples = 5, .smooth = false});
    for (int y = 0; y < 4; ++y) // patches from the bottom, pixels from the top
        for (int x = 0; x < 4; ++x)
            CHECK(image.at(x, y).x == Approx(4 * (3 - y) + x + 1));
}

TEST_CASE("smoothing shows a linear radiosity without steps") {
    const Mesh mesh = wall(8);
    const WideBvh bvh(mesh.soup());
    std::vector<Vec3> b;
    for (const Patch& patch : mesh.patches())
        b.push_back(Vec3(1 + mesh.frame().to_world(patch.centre).x));
    constexpr int size = 64;
    const Image image =
        render(mesh, bvh, b, square_camera, {.width = size, .height = size, .samples = 4});
    for (int x = size / 8; x < size * 7 / 8; ++x) // extrapolation ends at the middle of the rim
        CHECK(image.at(x, 20).x == Approx(1 + (x + 0.5) / size).epsilon(1e-5));
}

TEST_CASE("the edge of a surface in a pixel is mixed with the black behind it") {
    const Mesh mesh = wall(1);
    const WideBvh bvh(mesh.soup());
    Camera camera = square_camera;
    camera.eye.x = camera.target.x = 0; // the wall covers the right half
    const Image image = render(mesh, bvh, std::vector<Vec3>{Vec3(1)}, camera,
                               {.width = 3, .height = 3, .samples = 16});
    CHECK(image.at(0, 1).x == 0);
    CHECK(image.at(1, 1).x == Approx(0.5));
    CHECK(image.at(2, 1).x == Approx(1));
}

TEST_CASE("a picture does not depend on the number of threads") {
    const Mesh mesh(room_with_block());
    const WideBvh bvh(mesh.soup());
    std::vector<Vec3> b;
    for (const Patch& patch : mesh.patches())
        b.push_back(glm::abs(patch.centre) + 0.1);
    const Camera camera = automatic_camera(mesh, bvh, b);
    const CornerClasses known = find_corner_classes(mesh);
    const auto picture = [&](unsigned threads, const CornerClasses* classes) {
        return render(mesh, bvh, b, camera,
                      {.width = 50, .height = 37, .threads = threads, .classes = classes});
    };
    CHECK(picture(1, nullptr).pixels == picture(3, nullptr).pixels);
    CHECK(picture(1, nullptr).pixels == picture(1, &known).pixels);
}

TEST_CASE("a picture without pixels or samples is refused") {
    const Mesh mesh = wall(1);
    const WideBvh bvh(mesh.soup());
    const std::vector<Vec3> b{Vec3(1)};
    for (const RenderOptions& options :
         {RenderOptions{.width = 0}, RenderOptions{.height = -3}, RenderOptions{.samples = 0}})
        CHECK_THROWS_AS(render(mesh, bvh, b, square_camera, options), std::invalid_argument);
}

TEST_CASE("what lies behind a pane is dimmed by it") {
    Scene scene = wall(2).scene();
    const Pane left{{Vec3(-1, -1, .5), Vec3(.5, -1, .5), Vec3(.5, 2, .5), Vec3(-1, 2, .5)}, .7};
    const Pane behind{{Vec3(0, 0, -1), Vec3(1, 0, -1), Vec3(1, 1, -1), Vec3(0, 1, -1)}, 0};
    scene.panes = std::make_shared<const std::vector<Pane>>(std::vector<Pane>{left, behind});
    const Mesh mesh(std::move(scene));
    const MadeTracer made = make_tracer(mesh, 1);
    const std::vector<Vec3> b(4, {1, 2, 3});
    const Image image =
        render(mesh, *made.tracer, b, square_camera, {.width = 4, .height = 4, .samples = 4});
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x)
            CHECK(image.at(x, y).y == Approx(x < 2 ? 1.4 : 2));
}
