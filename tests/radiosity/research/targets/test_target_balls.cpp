// Balls around what counts most of a target: where they are, and what rays to them carry.
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/research/targets/target_balls.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <cmath>

using namespace hemilux;

namespace {

constexpr Vec3 up{0, 0, 1};

/// Mean of W over directions, and of its square.
struct Power {
    double mean = 0, square = 0;
};

Power power_through(const TargetBall& ball, int samples) {
    Rng rng(11);
    Power power;
    for (int k = 0; k < samples; ++k) {
        const double u = rng.uniform(), v = rng.uniform();
        const auto aimed = ball.aim({0, 0, 0}, up, {u, v});
        const double w = aimed ? aimed->power : 0;
        power.mean += w / samples;
        power.square += w * w / samples;
    }
    return power;
}

} // namespace

TEST_CASE("Rays to a ball carry the power that passes through it") {
    // A sphere above the horizon has the form factor sin^2(a) cos(theta), a being its half angle.
    const Vec3 place = GENERATE(Vec3(0, 0, 2), Vec3(1, .5, 1), Vec3(-3, 1, 1.2), Vec3(0, .9, .5));
    constexpr double radius = .3;
    const double distance = glm::length(place), sine = radius / distance;
    const Power power = power_through({place, radius}, 20000);
    const double exact = sine * sine * place.z / distance;
    const double sigma = std::sqrt((power.square - exact * exact) / 20000);
    CHECK(std::abs(power.mean - exact) < 4 * sigma + 1e-12);
}

TEST_CASE("Of a ball across the horizon, that of the part above") {
    const TargetBall ball{{1, 0, .1}, .4};
    const Power power = power_through(ball, 100000);
    Rng rng(12);
    double through = 0;
    for (int k = 0; k < 100000; ++k)
        through += ball.takes({0, 0, 0}, sample_cosine(rng)) ? 1e-5 : 0;
    CHECK(std::abs(power.mean - through) < 4 * std::sqrt(2 * through * 1e-5));
}

TEST_CASE("Aimed directions are those that the ball takes, and none are from near") {
    Rng rng(13);
    for (int k = 0; k < 2000; ++k) {
        const auto in = [&](double low, double high) { return low + (high - low) * rng.uniform(); };
        const TargetBall ball{{in(-1, 1), in(-1, 1), in(-1, 1)}, in(.01, 1)};
        const double u = in(.001, .999), v = rng.uniform();
        const auto aimed = ball.aim({0, 0, 0}, up, {u, v});
        const bool is_near = glm::length(ball.centre) <= 1.1 * ball.radius;
        if (is_near)
            CHECK(!aimed);
        if (is_near)
            CHECK(!ball.takes({0, 0, 0}, glm::normalize(ball.centre)));
        if (aimed) {
            CHECK(ball.takes({0, 0, 0}, aimed->direction));
            CHECK(aimed->power > 0);
        }
    }
}

TEST_CASE("Balls are put around each crowd of what counts") {
    Scene scene = test::room_with_block();
    const std::size_t before = scene.facets.size();
    test::add_cube(scene, {.7, .3, .06}, .05);
    test::add_cube(scene, {.2, .8, .9}, .02);
    const test::Model model(scene);
    std::vector<double> value;
    for (const Patch& patch : model.mesh.patches()) // alike A v
        value.push_back(patch.facet >= before ? 1 / patch.area : 0);
    const std::vector<TargetBall> balls = find_balls(model.mesh, value);
    REQUIRE(balls.size() >= 2);
    const double scale = model.mesh.frame().scale;
    double held = 0, all = 0;
    for (std::size_t i = 0; i < value.size(); ++i) {
        if (!(value[i] > 0))
            continue;
        ++all;
        for (const TargetBall& ball : balls)
            if (glm::length(model.mesh.patches()[i].centre - ball.centre) <= ball.radius) {
                ++held;
                break;
            }
    }
    CHECK(held >= .6 * all);
    for (const TargetBall& ball : balls)
        CHECK(ball.radius < .1 * scale);
    CHECK(find_balls(model.mesh, std::vector<double>(value.size())).empty());
}
