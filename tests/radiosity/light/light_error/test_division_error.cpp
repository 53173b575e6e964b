// The error of the light on the surfaces, against light in closed form and against finer divisions.
#include "geometry/frame.h"
#include "parallel/workers.h"
#include "radiosity/light/final_gather/final_gather.h"
#include "radiosity/light/final_gather/gather_in_parts.h"
#include "radiosity/light/final_gather/light_within_patches.h"
#include "radiosity/light/final_gather/linear_light.h"
#include "radiosity/light/final_gather/surface_points.h"
#include "radiosity/light/light_error/division_error.h"
#include "support/closed_forms.h"
#include "support/scenes.h"
#include "support/solve.h"
#include "support/targets.h"

#include "radiosity/light/cached_light/patch_light.h"
#include "support/catch.h"

#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

using namespace hemilux;
using test::Model;
using test::point_to_polygon;

namespace {

constexpr double lamp_emission = 100;

/// Ground of 4 x 4 m and a lamp of `width` at a height of 1 m, facing down.
Scene lamp_over_ground(double width) {
    Scene scene;
    scene.materials = {{"ground", Vec3(.2, .5, .8), Vec3(0)},
                       {"lamp", Vec3(0), Vec3(lamp_emission, .5 * lamp_emission, 0)}};
    scene.groups = {"default"};
    test::add_quad(scene, {-2, 0, -2}, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, 1, 1, 0);
    const double a = width / 2;
    test::add_quad(scene, {-a, 1, -a}, {a, 1, -a}, {a, 1, a}, {-a, 1, a}, 1, 1, 1);
    scene.faces = 2;
    return scene;
}

Polygon lamp_of(const Mesh& mesh) {
    for (const Patch& patch : mesh.patches())
        if (mesh.material(patch).emission != Vec3(0.0))
            return mesh.whole_side(patch.facet, false).shape;
    return {};
}

/// The error of a solution as a function on the ground, by a grid of points on each patch.
double true_error_on_ground(const Mesh& mesh, const Solution& solution) {
    const Polygon lamp = lamp_of(mesh);
    constexpr int grid = 24;
    double error = 0, size = 0;
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i) {
        const Patch& patch = mesh.patches()[i];
        if (mesh.material(i).emission != Vec3(0.0))
            continue;
        const auto& p = patch.shape.corner;
        for (int s = 0; s < grid; ++s)
            for (int t = 0; t < grid; ++t) {
                const double u = (s + .5) / grid, v = (t + .5) / grid;
                const Vec3 x = p[0] + u * (p[1] - p[0]) + v * (p[3] - p[0]);
                const Vec3 light = mesh.material(i).reflectance *
                                   point_to_polygon(x, patch.normal, lamp) *
                                   Vec3(lamp_emission, .5 * lamp_emission, 0);
                const Vec3 off = radiosity_at(mesh, solution, i, x) - light;
                error += solution.weight_of(i) * patch.area * glm::dot(off, off);
                size += solution.weight_of(i) * patch.area * glm::dot(light, light);
            }
    }
    return std::sqrt(error / size);
}

DivisionError division_error_of(const Model& model, const Solution& solution, std::uint64_t seed,
                                unsigned threads = 0, std::uint64_t max_rays = 1'000'000) {
    const StopFlag never;
    return division_error(model.mesh, model.bvh, solution,
                          {.seed = seed, .max_rays = max_rays, .negligible = 0}, Workers(threads),
                          never);
}

} // namespace

TEST_CASE("the error of a division is that against light in closed form", "[slow]") {
    const double width = GENERATE(.02, .3);
    const double max_edge = GENERATE(1.0, .5, .2);
    const Model model(lamp_over_ground(width), {.max_edge = max_edge});
    const bool has_target = GENERATE(false, true);
    std::vector<double> target; // what lies far from the lamp
    if (has_target)
        for (const Patch& patch : model.mesh.patches())
            target.push_back(
                std::max(glm::length(patch.centre - lamp_of(model.mesh).corner[0]) - .5, 0.0));
    const Solution solution = test::solve_for(model, *find_method("stored-transport"), target, {},
                                              {.steps = {}, .seconds = {}, .error = .002});
    const double truth = true_error_on_ground(model.mesh, solution);
    double mean_square = 0, mean_uncertainty = 0;
    constexpr int seeds = 8;
    for (int seed = 0; seed < seeds; ++seed) {
        const DivisionError found =
            division_error_of(model, solution, static_cast<std::uint64_t>(seed) + 1);
        CAPTURE(width, max_edge, has_target, seed, truth, found.error, found.uncertainty,
                found.points);
        CHECK(std::abs(found.error - truth) < 5 * found.uncertainty);
        CHECK(found.uncertainty < .2 * truth);
        mean_square += found.error * found.error / seeds;
        mean_uncertainty += found.uncertainty / seeds;
    }
    CAPTURE(width, max_edge, has_target, truth, mean_square, mean_uncertainty);
    CHECK(std::abs(std::sqrt(mean_square) - truth) < 4 * mean_uncertainty / std::sqrt(seeds));
}

TEST_CASE("linear functions are nearer to the light in closed form, and the error says how near") {
    const Model model(lamp_over_ground(.3), {.max_edge = .5});
    Solution solution = test::solve(model, *find_method("stored-transport"), {},
                                    {.steps = {}, .seconds = {}, .error = .002});
    const double constant = true_error_on_ground(model.mesh, solution);
    std::vector<std::uint32_t> all(model.mesh.patches().size());
    std::iota(all.begin(), all.end(), 0u);
    const StopFlag never;
    const LightWithinPatches one =
        light_within_patches({model.mesh, model.bvh, solution}, all, {}, Workers(1), never);
    const LightWithinPatches three =
        light_within_patches({model.mesh, model.bvh, solution}, all, {}, Workers(3), never);
    CHECK(one.square == three.square);
    CHECK(one.slopes.size() == all.size());
    for (const std::uint32_t i : all) {
        CHECK(one.slopes[i][0].x == three.slopes[i][0].x);
        solution.slope.push_back(agreed_slope(model.mesh.patches()[i], one.slopes[i]).slope);
    }
    const double linear = true_error_on_ground(model.mesh, solution);
    CHECK(linear < .5 * constant);
    // What is left, from few points a patch, is about the true one.
    const double left = std::sqrt(std::accumulate(one.square.begin(), one.square.end(), 0.0) /
                                  reflected_square(model.mesh, solution));
    CHECK(left == Approx(linear).epsilon(.3));
    const DivisionError found = division_error_of(model, solution, 1);
    CAPTURE(constant, linear, left, found.error, found.uncertainty);
    CHECK(std::abs(found.error - linear) < 5 * found.uncertainty);
}

TEST_CASE("a linear function has the patch's value in its centre and does not fall below 0") {
    const Model model(lamp_over_ground(.3));
    Solution solution;
    solution.radiosity.assign(model.mesh.patches().size(), Vec3(1, 2, 3));
    solution.slope.resize(model.mesh.patches().size());
    solution.slope[0] = {Vec3(10), Vec3(0)};
    const Patch& patch = model.mesh.patches()[0];
    CHECK(radiosity_at(model.mesh, solution, 0, patch.centre) == Vec3(1, 2, 3));
    const Frame axes = Frame::from_normal(patch.normal);
    CHECK(radiosity_at(model.mesh, solution, 0, patch.centre + .1 * axes.x).y == Approx(3));
    CHECK(radiosity_at(model.mesh, solution, 0, patch.centre - axes.x).x == 0);
}

TEST_CASE("a slope is less where its two estimates do not agree, and says how noisy it is") {
    const Model model(lamp_over_ground(.3));
    const Patch& patch = model.mesh.patches()[0];
    const Slope one{Vec3(3, 2, 1), Vec3(0)}, other{Vec3(1, 2, 3), Vec3(0)};
    const AgreedSlope same = agreed_slope(patch, {one, one});
    CHECK(same.slope.x == one.x);
    CHECK(same.noise == 0);
    const AgreedSlope less = agreed_slope(patch, {one, other});
    CHECK(less.slope.x.x < 2);
    CHECK(less.slope.x.x > 0);
    CHECK(less.noise > 0);
    CHECK(agreed_slope(patch, {one, {-one.x, -one.y}}).slope.x == Vec3(0));
}

TEST_CASE("an error of division is the same, and known better, by points where it is large") {
    const Model model(lamp_over_ground(.02), {.max_edge = .5});
    const Solution solution = test::solve(model, *find_method("stored-transport"), {},
                                          {.steps = {}, .seconds = {}, .error = .002});
    const double truth = true_error_on_ground(model.mesh, solution);
    std::vector<std::uint32_t> all(model.mesh.patches().size());
    std::iota(all.begin(), all.end(), 0u);
    const StopFlag never;
    const std::vector<double> square =
        light_within_patches({model.mesh, model.bvh, solution}, all, {}, Workers(0), never).square;
    for (const std::uint64_t seed : {1, 2, 3}) {
        const auto found = [&](std::span<const double> known) {
            return division_error(model.mesh, model.bvh, solution,
                                  {.seed = seed, .max_rays = 0, .square = known}, Workers(0),
                                  never);
        };
        const DivisionError uniform = found({}), directed = found(square);
        CAPTURE(truth, uniform.error, uniform.uncertainty, directed.error, directed.uncertainty);
        CHECK(std::abs(directed.error - truth) < 4 * directed.uncertainty);
        CHECK(directed.uncertainty < uniform.uncertainty);
    }
}

TEST_CASE("an error of division is known where a small bright face holds much of the light") {
    // One part in 1600 of the area, beside the lamp, so that it hides none of it from the ground.
    Scene scene = lamp_over_ground(.02);
    scene.materials.push_back({"plate", Vec3(.8), Vec3(0)});
    test::add_quad(scene, {.11, .95, -.05}, {.11, .95, .05}, {.21, .95, .05}, {.21, .95, -.05}, 1,
                   1, 2);
    scene.faces = 3;
    const Model model(std::move(scene), {.max_edge = .3});
    const Solution solution = test::solve(model, *find_method("stored-transport"), {},
                                          {.steps = {}, .seconds = {}, .error = .002});
    const double truth = true_error_on_ground(model.mesh, solution);
    for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
        const DivisionError found = division_error_of(model, solution, seed, 0, 100'000);
        CAPTURE(seed, truth, found.error, found.uncertainty, found.rays);
        CHECK(found.error > .8 * truth);
        CHECK(found.error < 1.25 * truth);
        CHECK(found.uncertainty < .15 * truth);
    }
}

TEST_CASE("light that does not change within patches has no error of division", "[slow]") {
    const Model model(test::furnace_box(3, .7));
    const Solution solution =
        test::solve(model, *find_method("stored-transport"), {}, test::steps(1));
    for (const std::uint64_t seed : {1, 2, 3, 4}) {
        const DivisionError found = division_error_of(model, solution, seed);
        CHECK(found.error < .01);
        const double square = found.error * found.error;
        const double sigma = std::pow(found.error + found.uncertainty, 2) - square;
        if (found.error < 1e-6) // the light is the same everywhere, but for rounding
            continue;
        CHECK(square < 3 * sigma);
        // Nor is it known to be 0.
        CHECK(found.error > .75 * found.uncertainty);
    }
}

TEST_CASE("noise of the patches' values is not taken for an error of division", "[slow]") {
    const Model model(test::furnace_box(4, .5));
    const char* method = GENERATE("monte-carlo", "hemisphere");
    const Solution solution =
        test::solve(model, *find_method(method), {.rays = 32}, test::steps(8));
    const double sampling = estimated_error(model.mesh, solution);
    const DivisionError found = division_error_of(model, solution, 1);
    CAPTURE(method, sampling, found.error, found.uncertainty);
    CHECK(sampling > .02);
    CHECK(found.error < .7 * sampling);
}

TEST_CASE("an error of division does not depend on the number of threads") {
    const Model model(test::room_with_block());
    const Solution solution =
        test::solve(model, *find_method("stored-transport"), {}, test::steps(1));
    const DivisionError one = division_error_of(model, solution, 7, 1);
    const DivisionError three = division_error_of(model, solution, 7, 3);
    CHECK(one.error == three.error);
    CHECK(one.uncertainty == three.uncertainty);
    CHECK(one.rays == three.rays);
    CHECK(one.error > .02);
}

TEST_CASE("an error of division is unknown where nothing is lit or the user has ended the run") {
    Scene scene = test::furnace_box(2, .5);
    for (Material& material : scene.materials)
        material.emission = Vec3(0.0);
    const Model dark(scene);
    const Solution black = test::solve(dark, *find_method("stored-transport"), {}, test::steps(1));
    CHECK(std::isnan(division_error_of(dark, black, 1).error));

    const Model model(test::furnace_box(2, .5));
    const Solution solution =
        test::solve(model, *find_method("stored-transport"), {}, test::steps(1));
    StopFlag now;
    now.set_wished(true);
    CHECK(std::isnan(division_error(model.mesh, model.bvh, solution, {}, Workers(1), now).error));
}

TEST_CASE("the errors of patches add up to that of the division") {
    const Model model(lamp_over_ground(.3), {.max_edge = .5});
    Solution solution = test::solve(model, *find_method("stored-transport"), {},
                                    {.steps = {}, .seconds = {}, .error = .002});
    const double truth = true_error_on_ground(model.mesh, solution);
    const StopFlag never;
    const std::vector<double> levels =
        patch_error_levels(model.mesh, model.bvh, solution, 1, Workers(0), never);
    double sum = 0, area = 0;
    for (std::size_t i = 0; i < levels.size(); ++i) {
        sum += model.mesh.patches()[i].area * levels[i] * levels[i];
        area += model.mesh.patches()[i].area;
    }
    CHECK(std::sqrt(sum / area) == Approx(truth).epsilon(.2));
    StopFlag interrupted;
    interrupted.set_wished(true);
    CHECK(patch_error_levels(model.mesh, model.bvh, solution, 1, Workers(0), interrupted).empty());
}
