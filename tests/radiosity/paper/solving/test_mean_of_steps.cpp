// The mean of independent steps, their spread and the power of a ray, against sums done here.

#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/solution/solve_error.h"
#include "radiosity/paper/solving/mean_of_steps.h"
#include "support/catch.h"
#include "support/paper_solve.h"
#include "support/scenes.h"

#include <cmath>
#include <limits>

using namespace hemilux;

namespace {

struct Fixture {
    test::PaperModel model{test::room_with_block()};
    SolveOptions options;
    Monitor monitor;
    SolverInput input{model.mesh, model.bvh, options, monitor};
};

/// A step whose reflected light is uniform over [0, 1) by patch and channel.
StepResult random_step(const Mesh& mesh, std::uint64_t seed) {
    StepResult step(mesh);
    Rng random(seed);
    for (std::size_t i = 0; i < step.radiosity.size(); ++i) {
        step.radiosity[i] += Vec3(random.uniform(), random.uniform(), random.uniform());
        step.hits[i] = static_cast<std::uint32_t>(i % 3);
        step.rays += step.hits[i];
    }
    step.escaped += Vec3(random.uniform());
    return step;
}

} // namespace

TEST_CASE("the mean of steps has the mean and the variance of samples") {
    const Fixture fixture;
    const Mesh& mesh = fixture.model.mesh;
    MeanOfSteps mean(fixture.input, true);
    std::vector<StepResult> steps;
    for (std::uint64_t k = 0; k < 5; ++k) {
        steps.push_back(random_step(mesh, k));
        mean.add(steps.back());
    }
    const auto n = static_cast<double>(steps.size());
    double variance = 0;
    std::uint64_t rays = 0;
    Vec3 escaped(0.0);
    for (const StepResult& step : steps) {
        rays += step.rays;
        escaped += step.escaped.value() / n;
    }
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i)
        for (int c = 0; c < 3; ++c) {
            double sum = 0, squares = 0;
            for (const StepResult& step : steps)
                sum += step.radiosity[i][c];
            for (const StepResult& step : steps)
                squares += std::pow(step.radiosity[i][c] - sum / n, 2);
            const double of_mean = squares / (n * (n - 1));
            CHECK(mean.solution.radiosity[i][c] == Approx(sum / n).epsilon(1e-12));
            variance += mesh.patches()[i].area * of_mean;
        }
    CHECK(*mean.solution.variance == Approx(variance).epsilon(1e-12));
    CHECK(mean.solution.rays_energy == rays);
    CHECK(mean.solution.hits[2] == 10);
    const Vec3 world = mesh.frame().area_to_world(1.0) * escaped;
    CHECK(mean.solution.energy.escaped.x == Approx(world.x).epsilon(1e-12));
}

TEST_CASE("the variance of the level is most of the variance where all patches err together") {
    const Fixture fixture;
    const Mesh& mesh = fixture.model.mesh;
    const auto level_share = [&](bool together) {
        MeanOfSteps mean(fixture.input, true);
        Rng random(3);
        for (int k = 0; k < 32; ++k) {
            StepResult step(mesh);
            double light = random.uniform();
            for (Vec3& radiosity : step.radiosity) {
                radiosity += Vec3(1 + light);
                if (!together)
                    light = random.uniform();
            }
            mean.add(step);
        }
        CHECK(mean.solution.variance_of_level <= *mean.solution.variance * (1 + 1e-12));
        return mean.solution.variance_of_level / *mean.solution.variance;
    };
    CHECK(level_share(true) > 0.5);
    CHECK(level_share(false) < 0.1);
}

TEST_CASE("a pilot finds the power of a ray") {
    Fixture fixture;
    fixture.options.rays = 20;
    const auto patches = static_cast<double>(fixture.model.mesh.patches().size());
    MeanOfSteps mean(fixture.input, true);
    CHECK_FALSE(mean.find_ray_power([](double, StepResult&) { return false; }));
    CHECK(mean.ray_power == 0);
    double asked = 0;
    CHECK(mean.find_ray_power([&](double ray_power, StepResult& pilot) {
        asked = ray_power;
        pilot.shot = 7;
        pilot.rays = 11;
        return true;
    }));
    CHECK(mean.ray_power == Approx(7 / (20 * patches)));
    const double more = 1 / (1 - mean_reflectance(fixture.model.mesh));
    CHECK(asked == Approx(mean.emitted() * more / 1000)); // the fewest rays of a pilot
    CHECK(mean.solution.rays_energy == 11);

    MeanOfSteps unequal(fixture.input, false);
    CHECK(unequal.find_ray_power([](double, StepResult&) { return false; })); // there is no pilot
    CHECK(unequal.ray_power == std::numeric_limits<double>::infinity());
}

TEST_CASE(
    "a patch that a few weak rays have hit is as uncertain as one that a mean ray would light") {
    const Fixture fixture;
    const Mesh& mesh = fixture.model.mesh;
    MeanOfSteps mean(fixture.input, true);
    mean.find_ray_power([](double, StepResult& pilot) {
        pilot.shot = 7;
        pilot.rays = 11;
        return true;
    });
    constexpr unsigned steps = 16;
    std::uint32_t patch = 0;
    while (mesh.material(patch).reflectance == Vec3(0.0))
        ++patch;
    const Patch& at = mesh.patches()[patch];
    const Vec3 strong = mesh.material(patch).reflectance * (mean.ray_power / at.area);
    const auto error_of = [&](unsigned weak_steps, double of_strong) {
        MeanOfSteps of_steps = mean;
        for (unsigned k = 0; k < steps; ++k) {
            StepResult step(mesh);
            if (k < weak_steps) {
                step.radiosity[patch] += (of_strong + .1 * of_strong * (k % 2)) * strong;
                step.hits[patch] = 1;
            }
            of_steps.add(step);
        }
        return mean_of_channels(of_steps.solution.standard_error[patch]);
    };
    const double one = mean_of_channels(strong) / steps;
    // The channels of a ray of mean power are those of the emission: one of them is a little more.
    CHECK(error_of(1, 1e-6) == Approx(one).epsilon(.05));
    CHECK(error_of(3, 1e-6) == Approx(one).epsilon(.05));
    CHECK(error_of(steps, 1e-6) < 1e-3 * one); // all bring about the same: that is known
}

TEST_CASE("a step that is not finite does not enter the mean") {
    const Fixture fixture;
    MeanOfSteps mean(fixture.input, true);
    StepResult step(fixture.model.mesh);
    step.radiosity[1].y = std::nan("");
    CHECK_THROWS_AS(mean.add(step), SolveError);
    CHECK(mean.solution.steps == 0);
}
