// Parts of the sky as columns, and what rays know of openings that they did not find.
#include "radiosity/engine/factors/pairs/exchange_area.h"
#include "radiosity/engine/factors/points/point_factors.h"
#include "radiosity/engine/factors/rows/row_rays.h"
#include "radiosity/engine/factors/rows/sky_bands.h"
#include "radiosity/engine/factors/rows/view_factors.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/solver.h"
#include "support/bare_scene.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <cmath>
#include <numbers>

using namespace hemilux;

namespace {

/// A floor beside a wall that hides a part of the sky.
Scene floor_and_wall() {
    Scene scene = test::bare_scene();
    test::add_quad(scene, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 1, 1, 0);
    test::add_quad(scene, {1, -1, 0}, {1, -1, 1}, {1, 2, 1}, {1, 2, 0}, 1, 1, 0);
    return scene;
}

double sum_of(std::span<const OpenShare> shares) {
    double sum = 0;
    for (const OpenShare& share : shares)
        sum += share.factor;
    return sum;
}

/// A floor under a wide lid with a hole of 4 % of a square.
Scene pinhole() {
    Scene scene = test::bare_scene();
    test::add_quad(scene, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 1, 1, 0);
    const double far = 300, low = .48, high = .52, z = 1;
    test::add_quad(scene, {-far, -far, z}, {-far, far, z}, {low, far, z}, {low, -far, z}, 1, 1, 0);
    test::add_quad(scene, {high, -far, z}, {high, far, z}, {far, far, z}, {far, -far, z}, 1, 1, 0);
    test::add_quad(scene, {low, -far, z}, {low, low, z}, {high, low, z}, {high, -far, z}, 1, 1, 0);
    test::add_quad(scene, {low, high, z}, {low, far, z}, {high, far, z}, {high, high, z}, 1, 1, 0);
    return scene;
}

} // namespace

TEST_CASE("Tregenza's patches are 145 of about one size, and each holds its middle") {
    for (const int up : {0, 1, 2}) {
        const SkyBands sky = SkyBands::tregenza(up);
        REQUIRE(sky.size() == 145);
        for (std::size_t k = 0; k < sky.size(); ++k)
            CHECK(sky.of(sky.middle(k)) == k);
        CHECK(sky.middle(144)[up] == 1);
        std::vector<int> counts(145);
        Rng random(7);
        constexpr int directions = 145'000;
        for (int k = 0; k < directions; ++k) { // uniform over the hemisphere
            const double z = random.uniform(), turn = 2 * std::numbers::pi * random.uniform();
            Vec3 direction(0.0);
            direction[up] = z;
            direction[(up + 1) % 3] = std::sqrt(1 - z * z) * std::cos(turn);
            direction[(up + 2) % 3] = std::sqrt(1 - z * z) * std::sin(turn);
            ++counts[sky.of(direction)];
        }
        for (std::size_t k = 0; k < 145; ++k) // solid angles from .0346 to .0475 of 2 pi
            CHECK((counts[k] > 650 && counts[k] < 1250));
    }
    const SkyBands sky = SkyBands::tregenza(2);
    CHECK(sky.middle(0).y > .9); // north, on the horizon
    CHECK(sky.of(glm::normalize(Vec3(1, .1, .1))) == 7);
    CHECK(sky.name(0) == "sky 1");
    CHECK(SkyBands::of_equal_steps(9, 2).name(8) == "sky 80-90");
    CHECK(SkyBands::of_equal_steps(8, 2).name(1) == "sky 11.3-22.5");
}

TEST_CASE("Bands of a free sky have the closed form sin^2, within their errors") {
    Scene scene = test::bare_scene();
    test::add_quad(scene, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 1, 1, 0);
    const test::Model model(std::move(scene));
    const SkyBands sky = SkyBands::of_equal_steps(9, 2);
    double squares = 0;
    constexpr int seeds = 40;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        RowView view;
        const FacingBacks backs(model.mesh);
        RowRays({model.mesh, model.bvh, backs, seed, 2, &sky}).trace(0, 1024, view);
        REQUIRE(view.bands.size() == 9);
        CHECK(sum_of(view.bands) == Approx(1));
        for (std::size_t k = 0; k < 9; ++k) {
            const auto below = [](std::size_t ring) {
                const double sine = std::sin(static_cast<double>(ring) * std::numbers::pi / 18);
                return sine * sine;
            };
            const double z =
                (view.bands[k].factor - (below(k + 1) - below(k))) / view.bands[k].standard_error;
            CHECK(std::abs(z) < 4);
            squares += z * z;
        }
    }
    CHECK(squares / (9 * seeds) < 1.2);
}

TEST_CASE("Bands sum to the sky of surfaces and of points") {
    const test::Model model(floor_and_wall());
    const SkyBands sky = SkyBands::tregenza(2);
    const std::vector<std::uint32_t> row_of{0, 1};
    Monitor monitor;
    const ViewFactors factors =
        view_factors(model.mesh, model.bvh, row_of, 2, {.bands = &sky}, Workers(1), monitor);
    for (std::uint32_t row = 0; row < 2; ++row) {
        REQUIRE(factors.bands_of(row).size() == 145);
        CHECK(sum_of(factors.bands_of(row)) == Approx(factors.open[row][0].factor).epsilon(1e-12));
        for (const OpenShare& band : factors.bands_of(row))
            CHECK(band.standard_error > 0);
    }
    // The wall hides what is low in the east of the floor.
    CHECK(factors.bands_of(0)[30 / 4].factor < .2 * factors.bands_of(0)[30 * 3 / 4].factor);
    const FactorPoint point{model.mesh.frame().to_local({.5, .5, 0}), {0, 0, 1}, 0};
    const auto rows = point_factors({&point, 1}, model.mesh, model.bvh, row_of, {.bands = &sky},
                                    Workers(1), monitor);
    CHECK(sum_of(rows[0].bands) == Approx(rows[0].open[0].factor).epsilon(1e-12));
    CHECK(rows[0].open[0].standard_error == 0);
}

TEST_CASE("An opening that rays miss has an error that covers it") {
    const test::Model model(pinhole());
    const double truth = exchange_area(model.mesh.patches()[0].shape,
                                       {{model.mesh.frame().to_local(Vec3(.48, .48, 1)),
                                         model.mesh.frame().to_local(Vec3(.48, .52, 1)),
                                         model.mesh.frame().to_local(Vec3(.52, .52, 1)),
                                         model.mesh.frame().to_local(Vec3(.52, .48, 1))}}) /
                         model.mesh.patches()[0].area;
    CHECK((truth > 3e-4 && truth < 6e-4));
    int missed = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        RowView view;
        const FacingBacks backs(model.mesh);
        RowRays({model.mesh, model.bvh, backs, seed, 2}).trace(0, 256, view);
        const auto& [sky, ground, back] = view.open;
        missed += sky.factor == 0;
        CHECK(std::abs(sky.factor - truth) < 3 * sky.standard_error);
        CHECK(sky.standard_error >= .5 / 256);
        CHECK((ground.factor == 0 && ground.standard_error == 0)); // the floor looks straight up
    }
    CHECK((missed > 20 && missed < 40));
}

TEST_CASE("What is known of a row bounds openings that no ray found") {
    const test::Model room(test::box_room({0, 0, 0}, {1, 1, 1}, 1, {Material{}}, {}));
    const test::Model roof(floor_and_wall());
    Monitor monitor;
    const std::vector<std::uint32_t> of_room{0, 1, 2, 3, 4, 5}, of_roof{0, 1};
    const ViewFactors closed =
        view_factors(room.mesh, room.bvh, of_room, 6, {}, Workers(1), monitor);
    for (const auto& shares : closed.open)
        for (const OpenShare& share : shares)
            CHECK((share.factor == 0 && share.standard_error < 1e-8)); // exact factors sum to 1
    const ViewFactors open = view_factors(roof.mesh, roof.bvh, of_roof, 2, {}, Workers(1), monitor);
    const auto& [sky, ground, back] = open.open[0];
    CHECK(sky.standard_error < 1e-8); // all the rest, as neither a back nor the ground faces it
    CHECK((ground.factor == 0 && ground.standard_error == 0));
    CHECK((back.factor == 0 && back.standard_error == 0));
    Scene hidden = floor_and_wall(); // a back in front of the floor, hidden by the wall
    test::add_quad(hidden, {2, 0, 0}, {2, .5, 0}, {2, .5, .5}, {2, 0, .5}, 1, 1, 0);
    const test::Model behind(std::move(hidden));
    const std::vector<std::uint32_t> of_behind{0, 1, 2};
    const ViewFactors more =
        view_factors(behind.mesh, behind.bvh, of_behind, 3, {}, Workers(1), monitor);
    CHECK(more.open[0][2].factor == 0);
    CHECK((more.open[0][2].standard_error > 0 && more.open[0][2].standard_error <= 1.5 / 1024));
    CHECK(more.open[0][0].standard_error > 0); // the sky may be a back where no ray went
}
