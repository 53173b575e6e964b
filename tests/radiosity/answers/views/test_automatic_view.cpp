#include "radiosity/answers/images/tone.h"
#include "radiosity/answers/pictures/render.h"
#include "radiosity/answers/views/automatic_camera.h"
#include "radiosity/light/lamps/emitter_shapes.h"
#include "support/catch.h"
#include "support/lit_scenes.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <algorithm>
#include <cmath>

using namespace hemilux;
using namespace hemilux::test;

namespace {

/// A scene with its light.
struct Lit {
    Model model;
    std::vector<Vec3> radiosity;

    explicit Lit(Scene scene, bool two_sided = false)
        : model(std::move(scene), {.two_sided = two_sided}),
          radiosity(
              solve(model, *find_method("stored-transport"), {.rays = 64}, steps(1)).radiosity) {}
    [[nodiscard]] AutomaticView view(const ViewWish& wish = {}) const {
        return automatic_view(model.mesh, model.bvh, radiosity, wish);
    }
};

/// Returns what share of a picture shows neither black nor lamps.
double lit_share(const Lit& lit, const Camera& camera) {
    const Image picture = render(lit.model.mesh, lit.model.bvh, lit.radiosity, camera,
                                 {.width = 80, .height = 60, .samples = 1});
    const Display display(exposure_of(picture, lit.model.mesh, lit.model.bvh, camera));
    double share = 0;
    for (const glm::vec3& pixel : picture.pixels) {
        const float y = luminance(display(pixel));
        share += (y > 0.02f && y < 0.999f) / 4800.0;
    }
    return share;
}

Scene lamp_room() {
    Scene scene = box_room({0, 0, 0}, {5, 3, 4}, 6,
                           {{"wall", Vec3(0.5), Vec3(0)}, {"lamp", Vec3(0), Vec3(5)}}, {});
    add_quad(scene, {2, 2.95, 1.5}, {3, 2.95, 1.5}, {3, 2.95, 2.5}, {2, 2.95, 2.5}, 1, 1, 1);
    return scene;
}

Vec3 forward(const Camera& camera) { return glm::normalize(camera.target - camera.eye); }

} // namespace

TEST_CASE("A pavilion with a luminous roof is looked into from its open side") {
    const std::array<Vec3, 4> open = {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 0, 1), Vec3(0, 0, -1)};
    for (int side = 0; side < 4; ++side) {
        INFO("open side " << side);
        const Lit lit(pavilion(side), true);
        const AutomaticView view = lit.view();
        CHECK(glm::dot(forward(view.camera), open[static_cast<std::size_t>(side)]) < -0.2);
        CHECK(view.lit > 0.3);
        CHECK(lit_share(lit, view.camera) > 0.4);
    }
}

TEST_CASE("A closed room is seen from within, with walls of one side or of two") {
    for (const bool two_sided : {false, true}) {
        INFO("two sides " << two_sided);
        const Lit lit(lamp_room(), two_sided);
        const AutomaticView view = lit.view();
        CHECK(glm::all(glm::greaterThan(view.camera.eye, Vec3(0))));
        CHECK(glm::all(glm::lessThan(view.camera.eye, Vec3(5, 3, 4))));
        CHECK(view.lit > 0.7);
        CHECK(lit_share(lit, view.camera) > 0.8);
    }
}

TEST_CASE("Where all light stays in a small case, the camera stands in it") {
    const Lit lit(lamp_in_case(), true);
    const AutomaticView view = lit.view();
    CHECK(glm::all(glm::greaterThan(view.camera.eye, Vec3(5, 0.1, 5))));
    CHECK(glm::all(glm::lessThan(view.camera.eye, Vec3(5.5, 0.6, 5.5))));
    CHECK(lit_share(lit, view.camera) > 0.5);
}

TEST_CASE("A thing in the sun is seen from a corner above it, on the side of the sun") {
    for (const double x : {-1.0, 1.0})
        for (const double z : {-1.0, 1.0}) {
            INFO("sun from " << x << " " << z);
            Scene scene = standing_thing();
            add_sun(scene, "sun", bounds_of(scene), {-x, -0.5, -z}, Vec3(1));
            const Camera camera = Lit(std::move(scene)).view({.up = 1}).camera;
            CHECK(forward(camera).y < -0.2);
            CHECK(forward(camera).y > -0.7);
            const Vec3 to_eye = -forward(camera);
            CHECK(to_eye.x * x + to_eye.z * z > 0.3);
            CHECK(std::min(std::abs(to_eye.x), std::abs(to_eye.z)) > 0.2);
        }
}

TEST_CASE("A cup under the sky is seen from outside, although the sky lights it within") {
    Scene cup = box_room({0, 0, 0}, {1, 1.2, 1}, 4, {{"clay", Vec3(0.6), Vec3(0)}}, {});
    std::erase_if(cup.facets, [&](const Facet& facet) {
        return std::ranges::all_of(facet.vertex, [&](auto v) { return cup.vertices[v].y == 1.2; });
    });
    add_sky(cup, "sky", bounds_of(cup), Vec3(1));
    const Camera camera = Lit(std::move(cup), true).view().camera;
    CHECK(glm::distance(camera.eye, Vec3(0.5, 0.6, 0.5)) > 1.5);
    CHECK(forward(camera).y < -0.2);
}

TEST_CASE("A scene that is turned together with its axis upwards is seen by the turned camera") {
    std::vector<Scene> scenes{pavilion(2), pavilion(1), lamp_room(), room_with_block(),
                              open_scene()};
    for (Scene& scene : scenes) {
        const Lit lit(scene, true);
        const Mesh turned(turned_to_z(scene), {.two_sided = true});
        const Camera a = lit.view({.up = 1}).camera,
                     b = automatic_view(turned, WideBvh(turned.soup()), lit.radiosity, {.up = 2})
                             .camera;
        CHECK(glm::distance(turned_to_z(a.eye), b.eye) < 1e-6);
        CHECK(glm::distance(turned_to_z(a.target), b.target) < 1e-6);
        CHECK(b.up == Vec3(0, 0, 1));
    }
}

TEST_CASE("Faint and blazing lamps give the same picture, by any number of threads") {
    const Lit lit(pavilion(2), true);
    const AutomaticView usual = lit.view({.threads = 1});
    const auto picture_of = [&](std::span<const Vec3> radiosity) {
        return render(lit.model.mesh, lit.model.bvh, radiosity, usual.camera,
                      {.width = 80, .height = 60});
    };
    const double exposure =
        exposure_of(picture_of(lit.radiosity), lit.model.mesh, lit.model.bvh, usual.camera);
    for (const double factor : {1e-12, 1e-3, 8.0, 1e9}) {
        INFO("factor " << factor);
        Lit other(pavilion(2, 0.4 * factor), true);
        for (std::size_t i = 0; i < lit.radiosity.size(); ++i)
            other.radiosity[i] = factor * lit.radiosity[i];
        const AutomaticView view = other.view({.threads = 3});
        CHECK(view.camera.eye == usual.camera.eye);
        CHECK(view.camera.target == usual.camera.target);
        CHECK(exposure_of(picture_of(other.radiosity), other.model.mesh, other.model.bvh,
                          view.camera) == Approx(exposure / factor).epsilon(1e-3));
    }
}
