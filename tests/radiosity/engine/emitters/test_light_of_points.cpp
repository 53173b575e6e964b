// Lights without extent: their cones, what they bring to patches, and all methods with them.
#include "parallel/workers.h"
#include "radiosity/engine/emitters/light_of_points.h"
#include "radiosity/engine/emitters/lit_by_points.h"
#include "radiosity/engine/rays/point_emitter.h"
#include "radiosity/paper/rays/shot.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

using namespace hemilux;
using test::Model;

namespace {

constexpr double pi = std::numbers::pi;

PointEmitter point_at(const Vec3& position, const Vec3& intensity = Vec3(1.0)) {
    return {.name = "p", .position = position, .intensity = intensity};
}

PointEmitter spot_at(const Vec3& position, const Vec3& axis, double inner, double outer) {
    return {.name = "s",
            .position = position,
            .axis = glm::normalize(axis),
            .intensity = Vec3(1.0),
            .cos_inner = std::cos(inner),
            .cos_outer = std::cos(outer)};
}

/// What arrives at the patches straight from the lights [W/m2].
std::vector<Vec3> light_on(const Model& model, std::uint32_t samples, unsigned threads = 1) {
    LightOfPoints light(model.mesh, model.bvh, {3, 4});
    const std::size_t n = model.mesh.patches().size();
    Monitor monitor;
    light.sample_up_to(std::vector<std::uint32_t>(n, samples), Workers(threads), monitor);
    std::vector<Vec3> found;
    for (std::uint32_t i = 0; i < n; ++i)
        found.push_back(light.irradiance(i));
    return found;
}

double power_on(const Model& model, std::span<const Vec3> light) {
    double power = 0;
    for (std::uint32_t i = 0; i < light.size(); ++i)
        power += model.mesh.frame().area_to_world(model.mesh.patches()[i].area) * light[i].x;
    return power;
}

/// A box of 4 x 3 x 5 m with some lights, and a block in it if asked for.
Scene box_with(const std::vector<PointEmitter>& lights, double reflectance, bool block = false) {
    Scene scene = test::box_room({-2, 0, -2.5}, {2, 3, 2.5}, 4,
                                 {{"wall", Vec3(reflectance), Vec3(0)}}, {0, 0, 0, 0, 0, 0});
    if (block)
        test::add_block(scene, {-.5, .5, -.5}, {.5, 1.5, .5});
    for (const PointEmitter& light : lights)
        add_point_emitter(scene, light);
    return scene;
}

} // namespace

TEST_CASE("A cone is full within the inner angle and falls as a square to the outer one") {
    const PointEmitter spot = spot_at(Vec3(0), {0, -1, 0}, .3, .6);
    const auto at = [&](double angle) {
        return relative_intensity(spot, {std::sin(angle), -std::cos(angle), 0});
    };
    CHECK(at(0) == 1);
    CHECK(at(.29) == 1);
    const double share = (std::cos(.5) - std::cos(.6)) / (std::cos(.3) - std::cos(.6));
    CHECK(at(.5) == Approx(share * share));
    CHECK(at(.61) == 0);
    CHECK(at(pi) == 0);
    CHECK(relative_intensity(point_at(Vec3(0)), {0, 1, 0}) == 1);
    CHECK(power_per_intensity(point_at(Vec3(0))) == Approx(4 * pi));
    CHECK(power_per_intensity(spot_at(Vec3(0), {0, 0, 1}, pi / 2, pi / 2)) == Approx(2 * pi));
    CHECK(power_per_intensity(spot_at(Vec3(0), {0, 0, 1}, 0, pi / 2)) == Approx(2 * pi / 3));
    // No direction within an angle has more than the bound.
    for (const double from : {0.0, .4, .7, 1.0})
        for (const double within : {.05, .3}) {
            const double most = max_relative_intensity(spot, {std::sin(from), -std::cos(from), 0},
                                                       std::cos(within), std::sin(within));
            CHECK(most >= at(from));
            CHECK(most >= at(from - within) - 1e-12);
        }
}

TEST_CASE("Lights that are no numbers are refused") {
    Scene scene;
    CHECK_THROWS_AS(add_point_emitter(scene, point_at(Vec3(NAN, 0, 0))), std::invalid_argument);
    CHECK_THROWS_AS(add_point_emitter(scene, point_at(Vec3(0), Vec3(1, -1, 1))),
                    std::invalid_argument);
    CHECK_THROWS_AS(add_point_emitter(scene, point_at(Vec3(0), Vec3(1, INFINITY, 1))),
                    std::invalid_argument);
    CHECK(point_emitters_of(scene).empty());
}

TEST_CASE("All that a light sends in a closed box arrives, without noise, wherever it stands") {
    for (const Vec3& place :
         {Vec3(0, 1.5, 0), Vec3(1.9999, .001, 2.4), Vec3(0, 1e-5, 0), Vec3(-1, 1e-3, 1.25)}) {
        const Model model(box_with({point_at(place)}, .5));
        CAPTURE(place.x, place.y, place.z);
        CHECK(power_on(model, light_on(model, 4)) == Approx(4 * pi).epsilon(1e-5));
    }
    const Model spot(box_with({spot_at({0, 2.9, 0}, {.2, -1, .1}, .3, .9)}, .5));
    CHECK(power_on(spot, light_on(spot, 256)) ==
          Approx(power_per_intensity(point_emitters_of(spot.mesh.scene())[0])).epsilon(1e-3));
}

TEST_CASE("Light that a block stops is on the block, and the same for any number of threads") {
    std::vector<PointEmitter> lights;
    for (int k = 0; k < 200; ++k)
        lights.push_back(point_at({-1.5 + .015 * k, 2.5, std::sin(k)}, Vec3(.01, .02, k % 2)));
    const Model model(box_with(lights, .5, true));
    const std::vector<Vec3> found = light_on(model, 256);
    CHECK(power_on(model, found) == Approx(200 * .01 * 4 * pi).epsilon(5e-3));
    CHECK(light_on(model, 256, 3) == found);
}

TEST_CASE("A light on a wall, on the edge of patches or behind a wall") {
    // On the ceiling, where all patches meet: half of its light goes down. The other half goes up,
    // where nothing is.
    const Model on_wall(box_with({point_at({0, 3, 0})}, .5));
    CHECK(power_on(on_wall, light_on(on_wall, 64)) == Approx(2 * pi).epsilon(1e-5));
    // Beyond the room nothing gets in: walls stop light from behind.
    const Model outside(box_with({point_at({0, 7, 0})}, .5));
    CHECK(power_on(outside, light_on(outside, 64)) == 0);
}

TEST_CASE("All methods find the light of points, with its energy", "[slow]") {
    const std::vector<PointEmitter> lights{point_at({.5, 1, .3}, {2, 1, 1}),
                                           spot_at({-1, 2.5, 1}, {.3, -1, -.2}, .4, .8)};
    const Model model(box_with(lights, .6, true));
    const Vec3 power = power_of_point_emitters(model.mesh.scene());
    const Needs needs = find_needs(model.mesh);
    SolveOptions options;
    options.rays = 200;
    const auto solved = [&](const Method& method, const StopRule& stop) {
        Monitor monitor;
        const SolverInput input{model.mesh, model.bvh, options, monitor, needs};
        const auto solver = make_solver(method, input);
        run(*solver, input, stop);
        return solver->solution();
    };
    const Solution truth = solved(*find_method("stored-transport"), {.error = .004});
    for (const Method* method : methods()) {
        CAPTURE(method->name);
        const Solution found = solved(*method, {.steps = 8, .error = .02});
        CHECK(found.energy.imbalance() < 1e-9);
        for (int c = 0; c < 3; ++c)
            CHECK(found.energy.emitted[c] == Approx(power[c]));
        const double error = true_error(model.mesh, found.radiosity, truth.radiosity).all;
        CAPTURE(error, estimated_error(model.mesh, found));
        CHECK(error < .05);
        CHECK(error < 3 * estimated_error(model.mesh, found) + .004);
    }
}
