// Solutions on patches against the light itself at points of the surfaces.
#include "parallel/workers.h"
#include "radiosity/light/final_gather/known_light.h"
#include "radiosity/light/light_error/division_error.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <cmath>

using namespace hemilux;
using test::Model;

namespace {

constexpr std::size_t points = 1 << 14;

KnownLight light_of(const Model& model, const Solution& accurate, std::uint64_t seed) {
    const StopFlag never;
    return {model.mesh, model.bvh, accurate.radiosity, points, seed, Workers(2), never};
}

std::vector<Vec3> scaled(const Model& model, const Solution& solution, double factor) {
    std::vector<Vec3> radiosity = solution.radiosity;
    for (std::uint32_t i = 0; i < radiosity.size(); ++i) {
        const Vec3 emission = model.mesh.material(i).emission;
        radiosity[i] = emission + factor * (radiosity[i] - emission);
    }
    return radiosity;
}

} // namespace

TEST_CASE("In a furnace the light is that of the patches, and what is added to it is the error") {
    const Model model(test::furnace_box(2, .5));
    const Solution accurate = test::reference(model, .001);
    const KnownLight light = light_of(model, accurate, 1);
    CHECK(!(light.error(accurate.radiosity) > .005)); // NaN: too small to be measured
    CHECK(light.error(scaled(model, accurate, 1.1)) == Approx(.1).epsilon(.02));
    CHECK(light.error(scaled(model, accurate, 0)) == Approx(1).epsilon(.02));
}

TEST_CASE("Against the light itself a solution is off by its noise and by its division", "[slow]") {
    const Model model(test::room_with_block());
    const Solution accurate = test::reference(model, .001);
    const StopFlag never;
    const double division = division_error(model.mesh, model.bvh, accurate,
                                           {.seed = 3, .max_rays = 2'000'000}, Workers(2), never)
                                .error;
    const KnownLight light = light_of(model, accurate, 4);
    CHECK(light.error(accurate.radiosity) == Approx(division).epsilon(.1));
    const double off = .3;
    CHECK(light.error(scaled(model, accurate, 1 + off)) > light.error(accurate.radiosity));
    const Solution noisy =
        test::solve(model, *find_method("stratified"), {.rays = 4}, test::steps(2));
    const double noise = true_error(model.mesh, noisy.radiosity, accurate.radiosity, {}).all;
    CHECK(noise > division / 2);
    CHECK(light.error(noisy.radiosity) == Approx(std::hypot(noise, division)).epsilon(.1));
}

TEST_CASE("Light that was interrupted, or that nothing reflects, is not known") {
    const Model model(test::furnace_box(2, .5)), black(test::furnace_box(2, 0));
    StopFlag stopped;
    stopped.set_wished(true);
    const std::vector<Vec3> radiosity(model.mesh.patches().size(), Vec3(1));
    const KnownLight unknown(model.mesh, model.bvh, radiosity, points, 1, Workers(1), stopped);
    CHECK(std::isnan(unknown.error(radiosity)));
    const StopFlag never;
    const KnownLight none(black.mesh, black.bvh, radiosity, points, 1, Workers(1), never);
    CHECK(std::isnan(none.error(radiosity)));
}
