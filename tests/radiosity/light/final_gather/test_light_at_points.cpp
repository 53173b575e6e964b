// The light at points that a user names, against closed forms.
#include "geometry/box.h"
#include "parallel/workers.h"
#include "radiosity/light/cached_light/light_cache.h"
#include "radiosity/light/final_gather/light_at_points.h"
#include "radiosity/paper/solving/stop_flag.h"
#include "support/closed_forms.h"
#include "support/scenes.h"
#include "support/solve.h"

#include "support/catch.h"

#include <cmath>
#include <limits>

using namespace hemilux;
using test::Model;
using test::point_to_polygon;

namespace {

/// Black ground of 4 x 4 m and a lamp of 0.4 x 0.4 m at a height of 1 m, facing down.
Scene lamp_over_ground() {
    Scene scene;
    scene.materials = {{"ground", Vec3(0), Vec3(0)}, {"lamp", Vec3(0), Vec3(10, 5, 0)}};
    scene.groups = {"default"};
    test::add_quad(scene, {-2, 0, -2}, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, 1, 1, 0);
    test::add_quad(scene, {-.2, 1, -.2}, {.2, 1, -.2}, {.2, 1, .2}, {-.2, 1, .2}, 1, 1, 1);
    scene.faces = 2;
    return scene;
}

std::vector<PointLight> light_of(const Model& model, const Solution& solution,
                                 const std::vector<Sensor>& sensors, unsigned threads = 0) {
    return light_at(sensors, model.mesh, model.bvh, SurfaceLight(model.mesh, solution),
                    {.rays = 1024}, Workers(threads))
        .lights;
}

/// The light as solve --points gives it out: what gathers read is learned before.
std::vector<PointLight> learned_light_at(std::span<const Sensor> sensors, const Model& model,
                                         const Solution& solution, std::uint64_t seed) {
    std::vector<TargetPart> parts;
    for (const Sensor& sensor : sensors)
        parts.push_back({{sensor.at}, {Vec3(1.0)}});
    LightCache cache(model.mesh, model.bvh, solution);
    const StopFlag never;
    const ReadError read = cache.learn(parts, {.seed = seed, .error = .03}, Workers(0), never);
    return light_at(sensors, model.mesh, model.bvh, cache.light(),
                    {.rays = 1024, .read_error = read.error * read.level, .seed = seed}, Workers(0))
        .lights;
}

Sensor sensor_of(const Model& model, const Vec3& position, const Vec3& normal) {
    return sensor_at(model.mesh, model.bvh, model.mesh.frame().to_local(position), normal);
}

} // namespace

TEST_CASE("light at points below a lamp is Lambert's") {
    const Model model(lamp_over_ground());
    const Solution solution =
        test::solve(model, *find_method("stored-transport"), {}, test::steps(1));
    const Vec3 tilted = glm::normalize(Vec3(.3, 1, .2));
    std::vector<Sensor> sensors;
    for (const double x : {0.0, .5, 1.0}) {
        sensors.push_back(sensor_of(model, {x, 0, .1}, {0, 1, 0}));   // on the ground
        sensors.push_back(sensor_of(model, {x, .5, .1}, tilted));     // in the air
        sensors.push_back(sensor_of(model, {x, .5, .1}, {0, -1, 0})); // away from the lamp
    }
    const std::vector<PointLight> lights = light_of(model, solution, sensors);
    REQUIRE(lights.size() == sensors.size());
    const Polygon lamp = model.mesh.whole_side(1, false).shape;
    for (std::size_t k = 0; k < sensors.size(); ++k) {
        const double factor = point_to_polygon(sensors[k].at.position, sensors[k].at.normal, lamp);
        CAPTURE(k, factor, lights[k].irradiance.x, lights[k].standard_error.x);
        CHECK(lights[k].irradiance.x ==
              Approx(10 * factor).epsilon(.02).margin(4 * lights[k].standard_error.x));
        CHECK(lights[k].irradiance.y == Approx(.5 * lights[k].irradiance.x));
        CHECK(lights[k].irradiance.z == 0);
        CHECK(lights[k].standard_error.x <= .05 * lights[k].irradiance.x);
    }
}

TEST_CASE("light in a furnace is the same at each point, in the air and on walls") {
    const Model model(test::furnace_box(3, .5));
    const Solution solution =
        test::solve(model, *find_method("stored-transport"), {}, test::steps(2));
    const Box box = box_of(model.mesh.vertices());
    const Patch& patch = model.mesh.patches()[3];
    const std::vector<Sensor> sensors{
        sensor_at(model.mesh, model.bvh, box.centre(), glm::normalize(Vec3(1, 2, 3))),
        sensor_at(model.mesh, model.bvh, patch.centre, patch.normal)};
    CHECK(sensors[0].patch == none);
    CHECK(sensors[1].patch == 3);
    const std::vector<PointLight> lights = light_of(model, solution, sensors);
    for (const PointLight& light : lights) {
        const double truth = solution.radiosity[0].x;
        CHECK(std::abs(light.irradiance.x - truth) <= 5 * light.standard_error.x + 1e-9 * truth);
        CHECK(light.standard_error.x < .02 * truth);
    }
}

TEST_CASE("a sensor lies on a face only where it looks along its normal") {
    const Model model(lamp_over_ground());
    CHECK(sensor_of(model, {1, 0, 1}, {0, 1, 0}).patch == 0);
    CHECK(sensor_of(model, {1, 1e-7, 1}, {0, 1, 0}).patch == 0); // a file has few digits
    CHECK(sensor_of(model, {1, -1e-7, 1}, {0, 1, 0}).at.facet == 0);
    CHECK(sensor_of(model, {1, 0, 1}, {0, -1, 0}).patch == none); // its back
    CHECK(sensor_of(model, {1, 0, 1}, glm::normalize(Vec3(.1, 1, 0))).patch == none);
    CHECK(sensor_of(model, {1, .01, 1}, {0, 1, 0}).patch == none);
    CHECK(sensor_of(model, {9, 0, 1}, {0, 1, 0}).patch == none);
}

TEST_CASE("the standard error of a point's light is how far runs scatter", "[slow]") {
    const Model model(test::room_with_block());
    std::vector<Sensor> sensors;
    for (const std::uint32_t i : {0u, 2u, 5u, 7u})
        sensors.push_back(sensor_at(model.mesh, model.bvh, model.mesh.patches()[i].centre,
                                    model.mesh.patches()[i].normal));
    constexpr int runs = 16;
    for (const char* method : {"stored-transport", "hemisphere"}) {
        std::vector<Vec3> sum(sensors.size()), squares(sensors.size()), reported(sensors.size());
        for (unsigned run = 0; run < runs; ++run) {
            const Solution solution = test::solve(model, *find_method(method),
                                                  {.rays = 256, .seed = run}, test::steps(8));
            const std::vector<PointLight> lights =
                learned_light_at(sensors, model, solution, 100 + run);
            for (std::size_t k = 0; k < sensors.size(); ++k) {
                sum[k] += lights[k].irradiance;
                squares[k] += lights[k].irradiance * lights[k].irradiance;
                reported[k] += lights[k].standard_error * lights[k].standard_error / double(runs);
            }
        }
        for (std::size_t k = 0; k < sensors.size(); ++k) {
            const double mean = sum[k].x / runs;
            const double variance = (squares[k].x / runs - mean * mean) * runs / (runs - 1);
            CAPTURE(method, k, mean, variance, reported[k].x);
            // Of so many runs the square scatters by a third.
            CHECK(variance < 2.5 * reported[k].x);
            CHECK(variance > reported[k].x / 4);
        }
    }
}

TEST_CASE("light at points does not depend on the number of threads") {
    const Model model(test::room_with_block());
    const Solution solution =
        test::solve(model, *find_method("stored-transport"), {}, test::steps(2));
    std::vector<Sensor> sensors;
    for (const Patch& patch : model.mesh.patches())
        sensors.push_back(sensor_at(model.mesh, model.bvh, patch.centre, patch.normal));
    const std::vector<PointLight> one = light_of(model, solution, sensors, 1),
                                  three = light_of(model, solution, sensors, 3);
    for (std::size_t k = 0; k < sensors.size(); ++k) {
        CHECK(one[k].irradiance == three[k].irradiance);
        CHECK(one[k].standard_error == three[k].standard_error);
    }
}

TEST_CASE("rays at points end by a limit, and the points that had theirs keep their light") {
    const Model model(test::room_with_block());
    const Solution solution =
        test::solve(model, *find_method("stored-transport"), {}, test::steps(2));
    std::vector<Sensor> sensors;
    for (int k = 0; k < 8192; ++k)
        sensors.push_back(sensor_at(model.mesh, model.bvh, Vec3(0, 0, k / 16384.0), {0, 0, 1}));
    const auto light = [&](const PointLightOptions& options, unsigned threads) {
        return light_at(sensors, model.mesh, model.bvh, SurfaceLight(model.mesh, solution), options,
                        Workers(threads));
    };
    const LightAtPoints some = light({.rays = 128, .max_all_rays = 300'000}, 1),
                        by_three = light({.rays = 128, .max_all_rays = 300'000}, 3),
                        all = light({.rays = 128}, 1);
    CHECK(some.end == PointsEnd::rays);
    CHECK(all.end == PointsEnd::right);
    CHECK(all.lights.size() == sensors.size());
    REQUIRE(some.lights.size() > 1000);
    REQUIRE(some.lights.size() < sensors.size());
    REQUIRE(by_three.lights.size() == some.lights.size());
    for (std::size_t k = 0; k < some.lights.size(); ++k) {
        CHECK(some.lights[k].irradiance == all.lights[k].irradiance);
        CHECK(by_three.lights[k].irradiance == all.lights[k].irradiance);
    }
    // What all points had before is not lost.
    const LightAtPoints in_two_passes = light({.noise = 1e-6, .max_all_rays = 2'000'000}, 0);
    CHECK(in_two_passes.end == PointsEnd::rays);
    CHECK(in_two_passes.lights.size() == sensors.size());
    CHECK(in_two_passes.noise > 0);
    // The first block has its light whatever ends the work.
    const LightAtPoints late = light({.rays = 128, .seconds = 0}, 0),
                        given_up = light({.rays = 128, .give_up = [] { return true; }}, 0);
    CHECK(late.end == PointsEnd::time);
    CHECK(given_up.end == PointsEnd::gave_up);
    for (const LightAtPoints* const found : {&late, &given_up}) {
        REQUIRE(found->lights.size() > 1000);
        REQUIRE(found->lights.size() < sensors.size());
        for (std::size_t k = 0; k < found->lights.size(); ++k)
            CHECK(found->lights[k].irradiance == all.lights[k].irradiance);
    }
}
