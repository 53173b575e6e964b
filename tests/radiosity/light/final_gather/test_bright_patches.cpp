// Rays that gathers aim at bright patches, against light in closed form.
#include "radiosity/light/final_gather/gather_in_parts.h"
#include "support/closed_forms.h"
#include "support/scenes.h"
#include "support/solve.h"

#include "radiosity/light/cached_light/patch_light.h"
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
        facing_down({0, 5, 0}, 4); // so far away that rays read it
        scene.faces = 4;
        return scene;
    }
    static std::vector<Vec3> radiosity() {
        return {Vec3(64), Vec3(64, 32, 16), Vec3(128), Vec3(1)};
    }

    Model model{scene()};
    std::vector<Vec3> light = radiosity();
    GatherInParts gather{model.mesh, model.bvh, SurfaceLight(model.mesh, PatchLight(light))};
    /// At x = -.3 to .3, which aim by the chances of the first.
    std::vector<SurfacePoint> points;

    Panels() {
        for (const double x : {0., .3, -.3, .1})
            points.push_back({model.mesh.frame().to_local({x, 0, 0}), {0, 1, 0}, none});
    }
    [[nodiscard]] double factor(const SurfacePoint& point, std::uint32_t patch) const {
        return point_to_polygon(point.position, point.normal, model.mesh.patches()[patch].shape);
    }
    /// Of the red channel, the mean of the points.
    [[nodiscard]] double irradiance() const {
        double sum = 0;
        for (const SurfacePoint& point : points) {
            const double panels = factor(point, 0) + factor(point, 1);
            sum += 64 * panels + (factor(point, 3) - panels);
        }
        return sum / double(points.size());
    }
    /// The mean of gathers by 16 rays at each of the points in turn, and its standard error.
    [[nodiscard]] std::pair<double, double> mean_of_gathers(bool partly_aimed) const {
        constexpr std::uint32_t gathers = 1024;
        double sum = 0, squares = 0;
        for (std::uint32_t k = 0; k < gathers; ++k) {
            const std::vector<GatherSamples> samples(points.size(), {k, 0, 16, partly_aimed});
            double mean = 0;
            for (const IndirectLight& found : gather.indirect(points, samples))
                mean += found.irradiance.x / double(points.size());
            sum += mean;
            squares += mean * mean;
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
    const SurfacePoint& point = panels.points[0];
    const IndirectLight found =
        panels.gather.indirect(std::span(&point, 1), std::span(&many, 1))[0];
    const auto square = [&](std::uint32_t patch) {
        const Vec3& light = panels.light[patch];
        return panels.factor(point, patch) * glm::dot(light, light) / 3;
    };
    const double bright = square(0) + square(1),
                 dim = panels.factor(point, 3) - panels.factor(point, 0) - panels.factor(point, 1);
    CHECK(found.bright_squares / found.squares == Approx(bright / (bright + dim)).epsilon(.01));
    CHECK(found.bright_squares / many.count == Approx(bright).epsilon(.05));
}
