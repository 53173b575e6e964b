// Rays that gathers aim at bright patches, against light in closed form.
#include "radiosity/final_gather/gather_in_parts.h"
#include "support/closed_forms.h"
#include "support/scenes.h"
#include "support/solve.h"

#include "support/catch.h"

#include <cmath>

using namespace hemilux;
using test::Model;
using test::point_to_polygon;

namespace {

/// Two panels above the origin, and a third that the second hides; a ceiling over all that is 64
/// times darker, and large enough that the panels are a sixteenth of the surface.
struct Panels {
    static constexpr std::uint32_t count = 3;

    static Scene scene() {
        Scene scene;
        scene.materials = {{"white", Vec3(.5), Vec3(0)}};
        scene.groups = {"default"};
        const auto facing_down = [&](const Vec3& centre, double half) {
            test::add_quad(scene, centre + Vec3(-half, 0, -half), centre + Vec3(half, 0, -half),
                           centre + Vec3(half, 0, half), centre + Vec3(-half, 0, half), 1, 1, 0);
        };
        facing_down({-1, 1, 0}, .1);
        facing_down({.5, 1, 0}, .25);
        facing_down({1, 2, 0}, .2);
        facing_down({0, 3, 0}, 4);
        scene.faces = 4;
        return scene;
    }
    static std::vector<Vec3> radiosity() {
        return {Vec3(64), Vec3(64, 32, 16), Vec3(128), Vec3(1)};
    }

    Model model{scene()};
    std::vector<Vec3> light = radiosity();
    GatherInParts gather{model.mesh, model.bvh, PatchLight(light)};
    SurfacePoint point{model.mesh.frame().to_local(Vec3(0)), {0, 1, 0}, none};

    /// Of the red channel.
    [[nodiscard]] double irradiance() const {
        const auto factor = [&](std::uint32_t patch) {
            return point_to_polygon(point.position, point.normal,
                                    model.mesh.patches()[patch].shape);
        };
        const double panels = factor(0) + factor(1);
        return 64 * panels + (factor(3) - panels);
    }
    /// The mean of gathers by 16 rays each, and its standard error.
    [[nodiscard]] std::pair<double, double> mean_of_gathers(bool partly_aimed) const {
        constexpr std::uint32_t gathers = 4096;
        const std::vector<SurfacePoint> points(gathers, point);
        std::vector<GatherSamples> samples;
        for (std::uint32_t k = 0; k < gathers; ++k)
            samples.push_back({k, 0, 16, partly_aimed});
        double sum = 0, squares = 0;
        for (const IndirectLight& light_found : gather.indirect(points, samples)) {
            sum += light_found.irradiance.x;
            squares += light_found.irradiance.x * light_found.irradiance.x;
        }
        const double mean = sum / gathers;
        return {mean, std::sqrt((squares / gathers - mean * mean) / gathers)};
    }
};

} // namespace

TEST_CASE("rays that are partly aimed at bright patches bring the light that arrives, and hidden "
          "ones bring none") {
    const Panels panels;
    const auto [mean, error] = panels.mean_of_gathers(true);
    CAPTURE(mean, panels.irradiance(), error);
    CHECK(std::abs(mean - panels.irradiance()) < 4 * error);
    CHECK(error < .01 * mean);
}

TEST_CASE("where bright patches send most of the light, aimed rays leave less noise than rays at "
          "random") {
    const Panels panels;
    const double aimed = panels.mean_of_gathers(true).second,
                 at_random = panels.mean_of_gathers(false).second;
    CAPTURE(aimed, at_random);
    CHECK(aimed < .6 * at_random);
}

TEST_CASE("rays at random say how much of the squares of light is of bright patches") {
    const Panels panels;
    const GatherSamples many{1, 0, 1u << 16};
    const IndirectLight found =
        panels.gather.indirect(std::span(&panels.point, 1), std::span(&many, 1))[0];
    const auto factor = [&](std::uint32_t patch) {
        return point_to_polygon(panels.point.position, panels.point.normal,
                                panels.model.mesh.patches()[patch].shape);
    };
    const auto square = [&](std::uint32_t patch) {
        const Vec3& light = panels.light[patch];
        return factor(patch) * glm::dot(light, light) / 3;
    };
    const double bright = square(0) + square(1), dim = factor(3) - factor(0) - factor(1);
    CHECK(found.bright_squares / found.squares == Approx(bright / (bright + dim)).epsilon(.01));
    CHECK(found.bright_squares / many.count == Approx(bright).epsilon(.05));
}
