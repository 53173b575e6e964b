// A run with a target: importance against the identity that defines it, what a target changes and
// what it must not.
#include "radiosity/engine/form_factors/exchange_matrix.h"
#include "radiosity/engine/form_factors/ray_counts.h"
#include "radiosity/engine/linear/conjugate_gradients.h"
#include "radiosity/engine/linear/surfaces.h"
#include "radiosity/engine/saving/state.h"
#include "radiosity/engine/stored_transport/importance.h"
#include "radiosity/engine/stored_transport/ray_allocation.h"
#include "radiosity/engine/target/target.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"
#include "support/targets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

using namespace hemilux;
using test::example;
using test::first_room;
using test::Model;
using test::solve_for;
using test::true_error_of;
using test::two_rooms;
using test::weights_of;

namespace {

const Method& stored_transport() { return *find_method("stored-transport"); }

/// Rays of one batch, of every third patch sixteen times as many.
RayCounts traced(const Model& model, std::uint32_t rays) {
    Monitor monitor;
    std::vector<std::uint32_t> all(model.mesh.patches().size(), rays);
    for (std::size_t i = 0; i < all.size(); i += 3)
        all[i] *= 16;
    RayCounts result(model.mesh, model.bvh, 5);
    result.trace_up_to(all, Workers(2), monitor);
    return result;
}

/// To an estimated error, which the steps are planned by.
Solution solve_to(const Model& model, std::span<const double> target, double error,
                  std::uint64_t seed) {
    SolveOptions options;
    options.seed = seed;
    options.stop.error = error;
    return solve_for(model, stored_transport(), target, options,
                     {.steps = {}, .seconds = {}, .error = error});
}

} // namespace

TEST_CASE("Importance says what light at any patch does for the target") {
    for (const Scene& scene : {test::room_with_block(), test::open_scene()}) {
        const Model model(scene);
        const Workers workers(2);
        const RayCounts rays = traced(model, 16);
        const Surfaces at(model.mesh);
        const ExchangeMatrix f(at.area, rays);
        const std::size_t n = at.area.size();
        std::vector<double> weight(n);
        for (std::size_t i = 0; i < n; i += 5)
            weight[i] = 1 + std::sin(double(i));
        std::vector<Vec3> first(n), incident(n);
        f.multiply(at.emission, first, workers);
        constexpr double exactly = 1e-13;
        const GradientsResult solved =
            solve_by_gradients(f, at.area, at.reflectance, first, incident, workers, exactly);
        REQUIRE(solved.converged);
        const std::vector<Vec3> importance =
            importance_of(f, at.area, at.reflectance, weight, workers, exactly);
        // sum w A B = sum A I E, B being E + rho h.
        Vec3 by_light(0.0), by_importance(0.0);
        for (std::size_t i = 0; i < n; ++i) {
            by_light += weight[i] * at.area[i] * (at.emission[i] + at.reflectance[i] * incident[i]);
            by_importance += at.area[i] * importance[i] * at.emission[i];
        }
        for (int c = 0; c < 3; ++c)
            CHECK(by_light[c] == Approx(by_importance[c]).epsilon(1e-10));
    }
}

TEST_CASE("Rays are important on the target, less so elsewhere, whatever the unit of the weights") {
    const Model model(two_rooms());
    const RayCounts rays = traced(model, 16);
    const Surfaces at(model.mesh);
    const ExchangeMatrix f(at.area, rays);
    std::vector<double> weight(at.area.size());
    std::fill_n(weight.begin(), 16, 1.0); // the floor of the first room
    std::vector<std::vector<double>> found;
    for (const double unit : {1.0, 7.0}) {
        for (double& each : weight)
            each *= unit;
        found.push_back(importance_of_rays(
            model.mesh, importance_of(f, at.area, at.reflectance, weight, Workers(1), 1e-12),
            weight));
    }
    for (std::size_t i = 0; i < weight.size(); ++i) {
        CHECK(found[0][i] == Approx(found[1][i]));
        if (i < 16)
            CHECK(found[0][i] >= 1);
        else if (i < 96)
            CHECK((found[0][i] > 0 && found[0][i] < 1));
        else
            CHECK(found[0][i] == 0);
    }
}

TEST_CASE("Rays go where they are important, and a quarter of the mean everywhere") {
    const std::size_t n = 1000;
    std::vector<double> weights(n, .1), usual(n, 1.0);
    std::fill_n(weights.begin(), 50, 100.0);
    std::fill_n(usual.begin(), 50, 15.0);
    const std::vector<std::uint32_t> none_yet(n, 0);
    const auto rays = allocate_rays(weights, 64, none_yet, usual);
    const auto sum = std::accumulate(rays.begin(), rays.end(), std::uint64_t{0});
    CHECK(sum > 32 * n);
    CHECK(sum <= 64 * n);
    for (std::size_t i = 0; i < n; ++i)
        CHECK(rays[i] >= (i < 50 ? 256u : 16u));
    CHECK(rays[0] >= 512);
}

TEST_CASE("A picture's weights are what it shows and what lights that") {
    const Model model(test::cube_with_lit_floor(2, .5));
    const auto patches = model.mesh.patches();
    std::vector<SurfacePoint> points;
    for (int k = 0; k < 64; ++k)
        points.push_back({patches[0].centre, patches[0].normal, patches[0].facet, 0});
    const std::vector<double> weight =
        weights_of_points(model.mesh, model.bvh, points, 16, Workers(2));
    CHECK(weight == weights_of_points(model.mesh, model.bvh, points, 16, Workers(1)));
    CHECK(weight[0] == 1);
    double others = 0;
    for (std::size_t i = 1; i < weight.size(); ++i) {
        others += weight[i] * patches[i].area / patches[0].area;
        CHECK((weight[i] > 0) == (patches[i].normal != patches[0].normal));
    }
    CHECK(others == Approx(.5 * .5)); // the square of what it reflects
}

TEST_CASE("With a target the result does not depend on threads, nor on an interruption") {
    const Model model(test::room_with_block());
    const std::vector<double> target = [&] {
        std::vector<double> weight(model.mesh.patches().size());
        std::fill_n(weight.begin(), 8, 1.0);
        return weight;
    }();
    SolveOptions options;
    options.threads = 1;
    const Solution one = solve_for(model, stored_transport(), target, options, test::steps(3));
    options.threads = 2;
    const Solution two = solve_for(model, stored_transport(), target, options, test::steps(3));
    CHECK(test::same_bits(one.radiosity, two.radiosity));
    CHECK(test::same_bits(one.standard_error, two.standard_error));
    CHECK(one.rays_energy == two.rays_energy);

    Monitor monitor;
    const SolverInput input{model.mesh, model.bvh, options, monitor, everything_needed, target};
    const auto first = stored_transport().make(input), second = stored_transport().make(input);
    first->step();
    const std::string state = test::hand_over(*first, *second);
    second->step();
    second->step();
    CHECK(test::same_bits(one.radiosity, second->solution().radiosity));

    std::vector<double> other = target;
    other[0] = .5;
    const SolverInput changed{model.mesh, model.bvh, options, monitor, everything_needed, other};
    StateReader again(state);
    CHECK_THROWS_AS(stored_transport().make(changed)->load(again), StateError);
}

TEST_CASE("A room that the target cannot see gets no more rays, and this is reported", "[slow]") {
    const Model model(two_rooms());
    const std::vector<double> target = first_room(model.mesh);
    const Solution all = solve_to(model, {}, .01, 3), some = solve_to(model, target, .01, 3);
    CHECK(all.figures.value("unneeded") == 0);
    CHECK(some.figures.value("unneeded") == target.size() / 2);
    CHECK(double(some.rays_energy) < .9 * double(all.rays_energy));
    CHECK(estimated_error(model.mesh, some) <= .01);
    CHECK(estimated_error_elsewhere(model.mesh, some) > .05);
    CHECK(std::isnan(estimated_error_elsewhere(model.mesh, all)));
    const Solution exact = test::reference(model, .0015);
    CHECK(true_error_of(model.mesh, some, exact, target) < .02);
}

TEST_CASE("A dark target goes on looking for light") {
    // The lamp of the second room alone shines.
    Scene scene = two_rooms();
    scene.materials[1].emission = Vec3(0.0);
    const Model model(scene);
    const Solution s = solve_for(model, stored_transport(), first_room(model.mesh), SolveOptions{},
                                 test::steps(2));
    CHECK(s.figures.value("unneeded") == 0);
    CHECK(std::isnan(estimated_error(model.mesh, s)));
}

TEST_CASE("A target that is all of the scene takes the rays of a run without", "[slow]") {
    for (const char* name : {"room_1002", "office_3576"}) {
        const Model model = example(name);
        const std::vector<double> all(model.mesh.patches().size(), 1.0);
        double without = 0, with = 0;
        for (std::uint64_t seed = 1; seed <= 4; ++seed) {
            without += double(solve_to(model, {}, .02, seed).rays_energy);
            with += double(solve_to(model, all, .02, seed).rays_energy);
        }
        CAPTURE(name, with, without);
        CHECK(std::abs(with / without - 1) < .05);
    }
}

TEST_CASE("One room of a building takes less than half of the rays of all", "[slow]") {
    const Model model = example("building_6");
    const std::vector<double> target = weights_of(model.mesh, "room_1");
    const Solution exact = solve_to(model, target, .002, 99);
    double rays_of_all = 0, rays = 0, square_of_all = 0, square = 0, log_ratio = 0;
    constexpr int runs = 6;
    for (std::uint64_t seed = 1; seed <= runs; ++seed) {
        const Solution whole = solve_to(model, {}, .02, seed);
        const Solution aimed = solve_to(model, target, .02, seed);
        const double off = true_error_of(model.mesh, aimed, exact, target);
        rays_of_all += double(whole.rays_energy);
        rays += double(aimed.rays_energy);
        square_of_all += std::pow(true_error_of(model.mesh, whole, exact, target), 2);
        square += off * off;
        log_ratio += std::log(estimated_error(model.mesh, aimed) / off) / runs;
    }
    CAPTURE(rays, rays_of_all, std::sqrt(square / runs), std::sqrt(square_of_all / runs));
    CHECK(rays < .5 * rays_of_all);
    CHECK(square < square_of_all);
    CHECK(std::exp(log_ratio) > .8);
    CHECK(std::exp(log_ratio) < 1.5);
}

TEST_CASE("Small things that are the target are right on average and as the error says", "[slow]") {
    const Model model = example("room_1002");
    const std::vector<double> target = weights_of(model.mesh, "detail");
    // By a method that knows nothing of targets.
    const Solution exact = test::reference(model, .0008);
    constexpr int runs = 8;
    double log_ratio = 0, worst = 0;
    std::vector<Vec3> mean(target.size());
    for (std::uint64_t seed = 1; seed <= runs; ++seed) {
        const Solution s = solve_to(model, target, .02, seed);
        CHECK(estimated_error(model.mesh, s) <= .02);
        const double off = true_error_of(model.mesh, s, exact, target);
        log_ratio += std::log(.02 / off) / runs;
        worst = std::max(worst, off);
        for (std::size_t i = 0; i < mean.size(); ++i)
            mean[i] += s.radiosity[i] / double(runs);
    }
    CAPTURE(std::exp(log_ratio), worst);
    CHECK(std::exp(log_ratio) > .7);
    CHECK(worst < .08);
    // The mean of the runs is nearer by about the root of their number: no bias of their size.
    Solution of_mean;
    of_mean.radiosity = mean;
    CHECK(true_error_of(model.mesh, of_mean, exact, target) < .015);
}
