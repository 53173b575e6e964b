// Where all light goes: emitted = absorbed + escaped + unshot to the last digits that doubles have,
// for every method, and what stands for chance in it is small.
#include "geometry/compensated_sum.h"
#include "radiosity/engine/solving/one_shot.h"
#include "radiosity/engine/solving/own_options.h"
#include "support/catch.h"
#include "support/layered_model.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <algorithm>
#include <cmath>

using namespace hemilux;
using Model = test::LayeredModel;

namespace {

constexpr double exact = 1e-10;

double largest(const Vec3& v) { return std::max({v.x, v.y, v.z}); }

/// Of what is emitted in each channel, or of the brightest channel where it is dark.
double share(const Vec3& power, const Vec3& emitted) {
    double most = 0;
    for (int c = 0; c < 3; ++c)
        most =
            std::max(most, std::abs(power[c]) / (emitted[c] > 0 ? emitted[c] : largest(emitted)));
    return most;
}

/// Sums over the published radiosities, not from what the method tells.
Vec3 power_emitted(const Model& model) {
    CompensatedSum<Vec3> sum;
    for (std::uint32_t i = 0; i < model.mesh.patches().size(); ++i)
        sum += model.mesh.frame().area_to_world(model.mesh.patches()[i].area) *
               model.mesh.material(i).emission;
    return sum.value();
}

Vec3 power_leaving(const Model& model, const Solution& s) {
    CompensatedSum<Vec3> sum;
    for (std::uint32_t i = 0; i < model.mesh.patches().size(); ++i)
        sum += model.mesh.frame().area_to_world(model.mesh.patches()[i].area) * s.radiosity[i];
    return sum.value();
}

/// What patches absorb of the light that the published radiosities say they receive; only where
/// all reflect.
Vec3 power_absorbed(const Model& model, const Solution& s) {
    CompensatedSum<Vec3> sum;
    for (std::uint32_t i = 0; i < model.mesh.patches().size(); ++i) {
        const Material& m = model.mesh.material(i);
        sum += model.mesh.frame().area_to_world(model.mesh.patches()[i].area) *
               (1.0 - m.reflectance) / m.reflectance * (s.radiosity[i] - m.emission);
    }
    return sum.value();
}

Solution check_balance(const Model& model, const Method& method, double rays = 32) {
    SolveOptions options;
    options.rays = rays;
    options.threads = 2;
    const Solution s = test::solve(model, method, options, test::steps(2));
    const Vec3 emitted = power_emitted(model);
    CAPTURE(method.name, s.energy.imbalance(), share(s.energy.unshot, emitted));
    CHECK(share(s.energy.emitted - emitted, emitted) < 1e-14);
    CHECK(s.energy.imbalance() < exact);
    for (int c = 0; c < 3; ++c) {
        CHECK(s.energy.absorbed[c] >= 0);
        CHECK(s.energy.escaped[c] >= 0);
    }
    if (method.name != "progressive") // which stops early
        CHECK(share(s.energy.unshot, power_leaving(model, s)) < .5);
    return s;
}

/// A closed room of walls, a lamp and things in it; `rho` of the brightest.
Scene closed_room(double rho) {
    Scene scene = test::room_with_block();
    scene.materials[0].reflectance = Vec3(rho);
    scene.materials[1].reflectance = Vec3(rho, rho / 2, .1);
    return scene;
}

Scene open_room(double rho) {
    Scene scene = test::open_scene();
    scene.materials[0].reflectance = Vec3(rho, rho, .4);
    return scene;
}

} // namespace

TEST_CASE("a compensated sum keeps what a plain one loses") {
    CompensatedSum<double> sum;
    for (const double term : {1.0, 1e100, 1.0, -1e100})
        sum += term;
    CHECK(sum.value() == 2);
    CompensatedSum<Vec3> sums;
    double plain = 0;
    for (int k = 0; k < 1'000'000; ++k) {
        sums += Vec3(.1, 1e-30, 0);
        plain += .1;
    }
    CHECK(sums.value().x == Approx(1e5).epsilon(1e-15));
    CHECK(sums.value().y == Approx(1e-24).epsilon(1e-15));
    CHECK(std::abs(plain - 1e5) > 1e-7);
}

TEST_CASE("what is missing in a balance is that of the worst channel") {
    EnergyBalance energy{Vec3(1, 2, 0), Vec3(.5, 1, 0), Vec3(.25, 1, 0), Vec3(.25, 0, 0)};
    CHECK(energy.imbalance() == 0);
    energy.absorbed.y = 1.5;
    CHECK(energy.imbalance() == Approx(.25));
    energy.absorbed.z = 1; // out of nothing
    CHECK(energy.imbalance() == Approx(.5));
    energy.escaped.x = NAN;
    CHECK(std::isnan(energy.imbalance()));
    CHECK(EnergyBalance{}.imbalance() == 0);
}

TEST_CASE("All methods account for all light, closed and open, dim and bright", "[slow]") {
    for (const double rho : {.5, .99})
        for (const bool open : {false, true}) {
            const Model model(open ? open_room(rho) : closed_room(rho));
            for (const Method* const method : methods()) {
                CAPTURE(rho, open);
                const Solution s = check_balance(model, *method);
                if (!open)
                    CHECK(s.energy.escaped == Vec3(0.0));
                else
                    CHECK(s.energy.escaped.x > 0);
            }
        }
}

TEST_CASE("In a closed room of reflectance .999 too") {
    const Model model(test::cube_with_lit_floor(3, .999));
    for (const Method* const method : methods()) {
        const Solution s = check_balance(model, *method);
        // By the radiosities alone: all is absorbed but what chance has left.
        const Vec3 emitted = power_emitted(model);
        const Vec3 off = power_absorbed(model, s) - s.energy.absorbed;
        // A difference of numbers 1000 times as large; and conjugate gradients end at a thousandth
        // of the standard error.
        const double error = estimated_error(model.mesh, s);
        const double unsolved =
            method->name == "stored-transport" ? 2e-3 * (std::isnan(error) ? 1 : error) : 0;
        CAPTURE(method->name, unsolved);
        CHECK(share(off, emitted) < 1e-9 + unsolved);
    }
}

TEST_CASE("Emission in one channel only, and of any size", "[slow]") {
    for (const double size : {1e-30, 1e30})
        for (const bool open : {false, true}) {
            Scene scene = open ? open_room(.8) : closed_room(.8);
            for (Material& material : scene.materials)
                material.emission *= Vec3(0, size, 0);
            const Model model(scene);
            for (const Method* const method : methods()) {
                CAPTURE(size, open);
                const Solution s = check_balance(model, *method);
                CHECK(s.energy.absorbed.x + s.energy.absorbed.z + s.energy.escaped.x == 0);
            }
        }
}

TEST_CASE("A bright and a faint lamp of different colours") {
    Scene scene = closed_room(.7);
    scene.materials.push_back({"faint", Vec3(.5), Vec3(0, 1e-30, 0)});
    scene.materials[3].emission = Vec3(1e30, 0, 0);
    scene.facets[0].material = 4;
    const Model model(scene);
    for (const Method* const method : methods()) {
        SolveOptions options;
        options.rays = 32;
        const Solution s = test::solve(model, *method, options, test::steps(2));
        CAPTURE(method->name, s.energy.imbalance());
        CHECK(s.energy.imbalance() < exact);
    }
}

TEST_CASE("Before the first step all is unshot, and printed rules say what they lose") {
    const Model model(closed_room(.7));
    for (const Method* const method : methods()) {
        SolveOptions options;
        Monitor monitor;
        const SolverInput input{model.mesh, model.bvh, options, monitor};
        const auto solver = method->make(input);
        CAPTURE(method->name);
        CHECK(solver->solution().energy.unshot == solver->solution().energy.emitted);
        CHECK(solver->solution().energy.imbalance() == 0);
        if (method->name != "hemisphere")
            continue;
        options.literal = true;
        options.rays = 16; // fewer than triangles: most round to no ray
        const Solution s = test::solve(model, *method, options, test::steps(2));
        CHECK(s.energy.imbalance() < exact);
        CHECK(s.energy.unshot.x > .05 * s.energy.emitted.x);
    }
}

TEST_CASE("Progressive radiosity leaves hardly anything unshot in the end") {
    for (const bool open : {false, true}) {
        const Model model(open ? open_room(.9) : closed_room(.9));
        SolveOptions options;
        options.rays = 16;
        set_own_options(options, OneShotOptions{.one_shot = false});
        const Solution s = test::solve(model, *find_method("progressive"), options,
                                       {.steps = {}, .seconds = {}, .error = .1});
        CAPTURE(open, s.steps, share(s.energy.unshot, s.energy.emitted));
        CHECK(s.energy.imbalance() < exact);
        CHECK(share(s.energy.unshot, power_leaving(model, s)) < .03);
    }
}

TEST_CASE("Many rays on few patches lose nothing by rounding", "[slow]") {
    const Model model(test::furnace_box(1, .9));
    for (const Method* const method : methods()) {
        const Solution s = check_balance(model, *method, 1e4);
        CHECK(share(s.energy.unshot, power_leaving(model, s)) <
              (method->name == "progressive" ? 1 : .001));
    }
}
