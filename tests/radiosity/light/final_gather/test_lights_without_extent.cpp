// What lights without extent bring to points, against I cos / r^2.
#include "parallel/workers.h"
#include "radiosity/engine/rays/candela_table.h"
#include "radiosity/engine/rays/point_emitter.h"
#include "radiosity/light/cached_light/light_cache.h"
#include "radiosity/light/final_gather/gather_in_parts.h"
#include "radiosity/light/final_gather/light_at_points.h"
#include "radiosity/paper/solving/stop_flag.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

using namespace hemilux;
using test::Model;

namespace {

constexpr double pi = std::numbers::pi;
const Vec3 place(.3, 1.5, -.2), axis = glm::normalize(Vec3(.2, -1, .1));

/// Ground of 6 x 6 m in one patch, a screen above a part of it, and one light or several.
Scene ground_below(const std::vector<PointEmitter>& lights) {
    Scene scene;
    scene.materials = {{"ground", Vec3(.5), Vec3(0)}, {"screen", Vec3(0), Vec3(0)}};
    scene.groups = {"default"};
    test::add_quad(scene, {-3, 0, -3}, {-3, 0, 3}, {3, 0, 3}, {3, 0, -3}, 1, 1, 0);
    test::add_quad(scene, {1, .5, 1}, {1, .5, 3}, {3, .5, 3}, {3, .5, 1}, 1, 1, 1);
    scene.faces = 2;
    for (const PointEmitter& light : lights)
        add_point_emitter(scene, light);
    return scene;
}

/// Ten places on the ground, on the axis, between the cones, outside of them; the last two are
/// behind the screen for the light at `place`.
std::vector<Vec3> ten_places() {
    const Vec3 on_axis = place + axis * (place.y / -axis.y);
    std::vector<Vec3> places{on_axis};
    for (const double away : {.1, .3, .5, .7, .9, 1.2, 2.0})
        places.push_back(on_axis + Vec3(-away, 0, -.3 * away));
    places.emplace_back(2.2, 0, 2.4);
    places.emplace_back(2.7, 0, 2.7);
    return places;
}

std::vector<PointLight> light_of(const Model& model, std::span<const Vec3> places,
                                 unsigned threads = 0) {
    const Solution solution =
        test::solve_as_needed(model, *find_method("stored-transport"), {}, test::steps(2));
    std::vector<Sensor> sensors;
    for (const Vec3& at : places)
        sensors.push_back(
            sensor_at(model.mesh, model.bvh, model.mesh.frame().to_local(at), {0, 1, 0}));
    return light_at(sensors, model.mesh, model.bvh, SurfaceLight(model.mesh, solution),
                    {.rays = 64}, Workers(threads))
        .lights;
}

double closed_form(const PointEmitter& light, const Vec3& at) {
    const Vec3 way = at - light.position;
    const double r = glm::length(way);
    double relative = 1;
    if (light.cos_outer >= -1) {
        const double cosine = glm::dot(way / r, light.axis);
        const double share = (cosine - light.cos_outer) / (light.cos_inner - light.cos_outer);
        relative = std::pow(std::min(std::max(share, 0.0), 1.0), 2);
    }
    return relative * -way.y / (r * r * r);
}

} // namespace

TEST_CASE("A point and a spot bring I cos / r^2 to ten places, and nothing behind a screen") {
    const PointEmitter point{.name = "p", .position = place, .intensity = Vec3(25, 5, 1)};
    const PointEmitter spot{.name = "s",
                            .position = place,
                            .axis = axis,
                            .intensity = Vec3(25, 5, 1),
                            .cos_inner = std::cos(.2),
                            .cos_outer = std::cos(.5)};
    for (const PointEmitter& light : {point, spot}) {
        const Model model(ground_below({light}));
        const std::vector<Vec3> places = ten_places();
        const std::vector<PointLight> found = light_of(model, places);
        for (std::size_t k = 0; k < places.size(); ++k) {
            CAPTURE(k, light.name);
            const double expected = k < 8 ? closed_form(light, places[k]) : 0;
            CHECK(found[k].irradiance.x == Approx(25 * expected).epsilon(1e-6).margin(1e-9));
            CHECK(found[k].irradiance.z == Approx(expected).epsilon(1e-6).margin(1e-9));
            CHECK(found[k].standard_error.x <= 1e-6);
        }
    }
}

TEST_CASE("A measured lamp brings its intensity over r^2 to ten places") {
    // Bilinear: 100 + gamma / 2 - C / 9 [cd], symmetric to the plane of C = 0.
    std::vector<double> gamma{0, 30, 90}, c{0, 60, 180}, candela;
    for (const double around : c)
        for (const double from_nadir : gamma)
            candela.push_back(100 + from_nadir / 2 - around / 9);
    const PointEmitter lamp{.name = "l",
                            .position = place,
                            .axis = {0, -1, 0},
                            .intensity = Vec3(1, .5, 0),
                            .table = std::make_shared<CandelaTable>(gamma, c, candela),
                            .side = {1, 0, 0}};
    const Model model(ground_below({lamp}));
    const std::vector<Vec3> places = ten_places();
    const std::vector<PointLight> found = light_of(model, places);
    for (std::size_t k = 0; k < 8; ++k) {
        const Vec3 way = places[k] - place;
        const double r = glm::length(way);
        const double from_nadir = std::acos(-way.y / r) * 180 / pi;
        const double around = std::acos(way.x / std::hypot(way.x, way.z)) * 180 / pi;
        const double expected = (100 + from_nadir / 2 - around / 9) * -way.y / (r * r * r);
        CHECK(found[k].irradiance.x == Approx(expected).epsilon(1e-6));
        CHECK(found[k].irradiance.y == Approx(expected / 2).epsilon(1e-6));
    }
}

TEST_CASE("Hundreds of lights are right on average, with their errors") {
    std::vector<PointEmitter> lights;
    for (int k = 0; k < 300; ++k)
        lights.push_back({.name = "p",
                          .position = {-2 + .013 * k, 1 + .5 * std::sin(k), std::cos(3.0 * k)},
                          .intensity = Vec3(1, k % 3, .5)});
    const Model model(ground_below(lights));
    const std::vector<Vec3> places{{-1, 0, -1}, {0, 0, .4}, {.5, 0, -2}};
    const std::vector<PointLight> found = light_of(model, places),
                                  alone = light_of(model, places, 1);
    for (std::size_t k = 0; k < places.size(); ++k) {
        Vec3 expected(0.0);
        for (const PointEmitter& light : lights)
            expected += light.intensity * closed_form(light, places[k]);
        CHECK(found[k].irradiance == alone[k].irradiance);
        for (int c = 0; c < 3; ++c)
            CHECK(std::abs(found[k].irradiance[c] - expected[c]) <
                  4 * found[k].standard_error[c] + 1e-6 * expected[c]);
    }
}

TEST_CASE("Size and units do not matter") {
    for (const double size : {1e-3, 1e6}) {
        Scene scene = ground_below({});
        for (Vec3& vertex : scene.vertices)
            vertex *= size;
        add_point_emitter(scene,
                          {.name = "p", .position = size * place, .intensity = Vec3(size * size)});
        const Model model(std::move(scene));
        const std::vector<Vec3> at{size * Vec3(.5, 0, .5)};
        const PointEmitter unit{.name = "p", .position = place};
        CHECK(light_of(model, at)[0].irradiance.x ==
              Approx(closed_form(unit, {.5, 0, .5})).epsilon(1e-6));
    }
}

TEST_CASE("Pictures add the light of points where they look, and none if only reflected is asked") {
    const PointEmitter light{.name = "p", .position = place, .intensity = Vec3(2)};
    const Model model(ground_below({light}));
    const Solution solution =
        test::solve(model, *find_method("stored-transport"), {}, test::steps(1));
    const SurfaceLight surfaces(model.mesh, solution);
    const Vec3 at(.4, 0, .1);
    const std::vector<SurfacePoint> points{{model.mesh.frame().to_local(at), {0, 1, 0}, 0, 0}};
    const std::vector<GatherSamples> samples{{1, 0, 4}};
    CHECK(GatherInParts(model.mesh, model.bvh, surfaces).from_points(points, samples)[0].x ==
          Approx(2 * closed_form(light, at)));
    CHECK(GatherInParts(model.mesh, model.bvh, surfaces, true).from_points(points, samples)[0] ==
          Vec3(0));
}

TEST_CASE("In a white sphere the light of a point is that of an integrating sphere") {
    constexpr double radius = 2, reflectance = .8, intensity = 3;
    Scene scene = test::sphere(3, radius, reflectance, 0);
    add_point_emitter(scene, {.name = "p", .position = Vec3(0), .intensity = Vec3(intensity)});
    const Model model(std::move(scene));
    const Solution solution =
        test::solve_as_needed(model, *find_method("stored-transport"), {}, {.error = .003});
    // All of it is lit alike, and sends P rho / (A (1 - rho)).
    double area = 0;
    for (const Patch& patch : model.mesh.patches())
        area += model.mesh.frame().area_to_world(patch.area);
    const double indirect = 4 * pi * intensity * reflectance / (area * (1 - reflectance));
    const Vec3 normal = glm::normalize(Vec3(-.5, .3, .8));
    const std::vector<Vec3> inside{{.1, .2, -.3}};
    const Vec3 local = model.mesh.frame().to_local(inside[0]);
    const Sensor sensor = sensor_at(model.mesh, model.bvh, local, normal);
    const PointLight found =
        light_at(std::vector{sensor}, model.mesh, model.bvh, SurfaceLight(model.mesh, solution),
                 {.rays = 4096}, Workers(0))
            .lights[0];
    const Vec3 way = -inside[0];
    const double direct =
        intensity * std::max(glm::dot(way, normal), 0.0) / std::pow(glm::length(way), 3);
    CHECK(found.irradiance.x == Approx(direct + indirect).epsilon(.01));
}

TEST_CASE("Walks from points find what patches lack of the light of a spot", "[slow]") {
    // The edge of a spot on one large patch: gathers read its mean, walks its place.
    Scene scene = test::box_room({-1, 0, -1}, {1, 2, 1}, 1, {{"wall", Vec3(.7), Vec3(0)}},
                                 {0, 0, 0, 0, 0, 0});
    add_point_emitter(scene, {.name = "s",
                              .position = {0, 1.9, 0},
                              .axis = {0, -1, 0},
                              .intensity = Vec3(10),
                              .cos_inner = std::cos(.15),
                              .cos_outer = std::cos(.2)});
    const Model model(scene);
    const auto solved = [](const Model& of) {
        return test::solve_as_needed(of, *find_method("stored-transport"), {}, {.error = .005});
    };
    const auto read_at_ceiling = [](const Model& of, const Solution& solution) {
        LightCache cache(of.mesh, of.bvh, solution);
        const Sensor sensor =
            sensor_at(of.mesh, of.bvh, of.mesh.frame().to_local({0, 2, 0}), {0, -1, 0});
        const StopFlag never;
        const ReadError read = cache.learn(std::vector<TargetPart>{{{sensor.at}, {Vec3(1.0)}}},
                                           {.error = .02}, Workers(0), never);
        const PointLight found =
            light_at(std::vector{sensor}, of.mesh, of.bvh, cache.light(),
                     {.rays = 4096, .read_error = read.error * read.level}, Workers(0))
                .lights[0];
        return found;
    };
    const PointLight coarse = read_at_ceiling(model, solved(model));
    const Model fine(scene, {.max_edge = .1});
    const PointLight right = read_at_ceiling(fine, solved(fine));
    CHECK(std::abs(coarse.irradiance.x - right.irradiance.x) <
          4 * (coarse.standard_error.x + right.standard_error.x));
    CHECK(coarse.irradiance.x == Approx(right.irradiance.x).epsilon(.05));
}
