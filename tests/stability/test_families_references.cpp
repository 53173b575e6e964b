// The references of the hard scenes, compared with closed forms and with each other: what they are
// made of, what must hold for all of them, and walks from patch to patch that know nothing of it.
#include "radiosity/engine/solving/run.h"
#include "support/catch.h"
#include "support/closed_forms.h"
#include "support/families/builders.h"
#include "support/families/gauss_rule.h"
#include "support/families/reliability.h"
#include "support/families/walks.h"
#include "support/statistics.h"

#include <array>
#include <cmath>
#include <numbers>

using namespace hemilux;
using namespace hemilux::test;

namespace {

const HardSceneEntry& entry(const std::string& family, const std::string& name) {
    for (const HardSceneEntry& e : hard_scenes())
        if (e.family == family && e.name == name)
            return e;
    throw std::out_of_range(family + ": " + name);
}

const HardScene& scene_of(const std::string& family, const std::string& name) {
    return hard_scene(entry(family, name));
}

/// Mean reflected radiosity of a group of patches, channel 0.
double mean_reflected(const Scene& scene, const std::vector<Vec3>& radiosity,
                      const std::vector<std::uint32_t>& group) {
    double sum = 0, area = 0;
    for (const std::uint32_t i : group) {
        const double a = polygon_of(scene, i).area();
        sum += a * (radiosity[i].x - scene.materials[scene.facets[i].material].emission.x);
        area += a;
    }
    return sum / area;
}
double mean_reflected(const HardScene& hard, const std::vector<std::uint32_t>& group) {
    return mean_reflected(hard.scene, hard.reference, group);
}

/// By so many rays as it takes by itself.
Solution shot(const PreparedScene& scene, const Method& method, std::uint64_t seed) {
    SolveOptions options;
    options.seed = seed;
    Monitor monitor;
    const SolverInput input{scene.mesh(), scene.tracer(), options, monitor, scene.needs()};
    const auto solver = method.make(input);
    run(*solver, input, stop_rule(method, {}));
    return solver->solution();
}

/// The controls' references take seconds, and are made by the library.
bool is_control(const HardSceneEntry& e) { return e.family == "control"; }

} // namespace

TEST_CASE("A Gauss rule integrates polynomials exactly") {
    for (const int n : {1, 2, 4, 8, 64}) {
        double weights = 0, moment = 0;
        for (const GaussPoint& p : gauss_rule(n)) {
            weights += p.weight;
            moment += p.weight * std::pow(p.at, 2 * n - 1);
        }
        CHECK(weights == Approx(1).epsilon(1e-13));
        CHECK(moment == Approx(1.0 / (2 * n)).epsilon(1e-12));
    }
}

TEST_CASE("Exchange in the open has the closed forms, near and far") {
    for (const double distance : {.5, 1., 5., 20., 100.}) {
        const Polygon low = parallelogram({0, 0, 0}, {0, 0, 1}, {1, 0, 0});
        const Polygon high = parallelogram({0, distance, 0}, {1, 0, 0}, {0, 0, 1});
        CAPTURE(distance);
        CHECK(exchange_in_the_open(low, high) ==
              Approx(opposed_rectangles(1 / distance, 1 / distance)).epsilon(1e-7));
    }
    const Polygon floor = parallelogram({0, 0, 0}, {0, 0, 1}, {1, 0, 0});
    const Polygon wall = parallelogram({0, 0, 0}, {0, 1, 0}, {0, 0, 1});
    CHECK(exchange_in_the_open(floor, wall) == Approx(.20004378).epsilon(1e-7));
    ExchangeTable table;
    CHECK(table(floor, wall) == exchange_in_the_open(floor, wall));
    CHECK(table(wall, floor) == exchange_in_the_open(floor, wall));
}

TEST_CASE("The exchange through a hole that hides nothing is that in the open") {
    // Unit cubes side by side without their common wall.
    const Polygon hole = parallelogram({1, 0, 0}, {0, 0, 1}, {0, 1, 0});
    const Polygon far_left = parallelogram({0, 0, 0}, {0, 1, 0}, {0, 0, 1});
    const Polygon far_right = parallelogram({2, 0, 0}, {0, 0, 1}, {0, 1, 0});
    const Polygon floor_right = parallelogram({1, 0, 0}, {0, 0, 1}, {1, 0, 0});
    for (const Polygon& to : {far_right, floor_right}) {
        const std::array<Aperture, 1> behind{{{far_left, Side::opposite}}};
        // As functions of the point of the hole, these have kinks.
        CHECK(exchange_through(hole, to, behind, 24) ==
              Approx(exchange_in_the_open(far_left, to)).epsilon(3e-3));
        // From points of the far wall instead: what it sees of `to` through the hole is all of it.
        const std::array<Aperture, 1> through{{{hole, Side::same}}};
        CHECK(exchange_through(far_left, to, through, 24) ==
              Approx(exchange_in_the_open(far_left, to)).epsilon(1e-5));
    }
}

TEST_CASE("Through a pinhole opposite walls exchange what one of them sees of it") {
    // Seen from the hole the walls cover each other.
    constexpr double edge = 1e-4;
    const Polygon hole =
        parallelogram({1, .5 - edge / 2, .5 - edge / 2}, {0, 0, edge}, {0, edge, 0});
    const Polygon left_wall = parallelogram({0, 0, 0}, {0, 1, 0}, {0, 0, 1});
    const Polygon right_wall = parallelogram({2, 0, 0}, {0, 0, 1}, {0, 1, 0});
    const std::array<Aperture, 1> behind{{{left_wall, Side::opposite}}};
    const double exchange = exchange_through(hole, right_wall, behind, 4);
    CHECK(exchange == Approx(edge * edge * .23945647).epsilon(1e-3));
    CHECK(exchange_in_the_open(left_wall, hole) == Approx(edge * edge * .23945647).epsilon(1e-6));
}

TEST_CASE("Rows of form factors have the sums that they must have, and references are physical",
          "[slow]") {
    for (const HardSceneEntry& e : hard_scenes()) {
        if (is_control(e))
            continue;
        const HardScene& hard = hard_scene(e);
        CAPTURE(e.family, e.name, hard.row_error);
        const bool through_holes = e.family == "pinhole" || e.family == "shade";
        CHECK(hard.row_error < (e.family == "corridor" ? 1e-3 : through_holes ? 1e-4 : 1e-8));
        CHECK(hard.reference.size() == hard.scene.facets.size());
        CHECK(hard.reference_error.size() == hard.reference.size());
        CHECK(!hard.parts.empty());
        const Mesh mesh(hard.scene, hard.options);
        REQUIRE(mesh.patches().size() == hard.reference.size());
        for (std::uint32_t i = 0; i < hard.reference.size(); ++i)
            for (int c = 0; c < 3; ++c)
                if (!(hard.reference[i][c] >= mesh.material(i).emission[c])) {
                    CAPTURE(i, c, hard.reference[i][c]);
                    CHECK(hard.reference[i][c] >= mesh.material(i).emission[c]);
                }
    }
}

TEST_CASE("A lamp over the ground: a point below its centre, and far away the square law") {
    // With the lamp large and near, patches are no points; so the far ones.
    for (const auto& [name, height, width] : {std::tuple{"height 100 width 1", 100., 1.},
                                              {"height 1000 width 1", 1e3, 1.},
                                              {"height 10000 width 1", 1e4, 1.},
                                              {"height 100000 width 1", 1e5, 1.}}) {
        const HardScene& hard = scene_of("lamp", name);
        const double emission = hard.reference.back().x;
        const double a = width / 2 / height;
        CAPTURE(name);
        CHECK(hard.reference[44].x ==
              Approx(.5 * emission * 4 * point_under_corner(a, a)).epsilon(2e-4));
        CHECK(hard.reference[44].x ==
              Approx(.5 * emission * width * width / (std::numbers::pi * height * height))
                  .epsilon(2e-4));
    }
}

TEST_CASE("The sun gives the ground the irradiance that it was made for") {
    // 1 on a surface that faces it; the ground has the cosine .4 / sqrt(1.16).
    const HardScene& hard = scene_of("sun", "ground");
    CHECK(mean_reflected(hard, hard.parts[0]) == Approx(.5 * .4 / std::sqrt(1.16)).epsilon(1e-4));
    const HardScene& both = scene_of("sun", "ground and panel");
    CHECK(mean_reflected(both, both.parts[0]) > mean_reflected(hard, hard.parts[0]) + .2);
}

TEST_CASE("Through the roof comes the sunlight that falls on the opening") {
    // Of one of 25 cells of 0.8 x 0.8 m; the room's reference holds it as what is absorbed and what
    // gets out again, which is not known in closed form: so by walks.
    const PreparedScene scene(scene_of("sun", "room with roof opening"));
    const HardScene& hard = scene.hard();
    const WalkResult walks = walk(scene.mesh(), scene.tracer(), hard.parts[0], 100'000, 1);
    const double right = mean_reflected(hard, hard.parts[0]);
    CAPTURE(right, walks.mean, walks.standard_error);
    CHECK(walks.standard_error < .03 * right);
    CHECK(normal_p_value((walks.mean - right) / walks.standard_error) > significance);
}

TEST_CASE("Walks find the mean radiosity of rooms with windows, stars, slits, doors", "[slow]") {
    struct Case {
        const char *family, *name;
        std::size_t part;
        double accuracy;
    };
    const std::vector<Case> cases{
        {"window", "reflectance 0.8, 5 cells open", 0, .02},
        {"window", "reflectance 0.95, 20 cells open", 0, .02},
        {"tiny", "900 equal lamps", 0, .04},
        {"shade", "0.1, reflectance 0.5", 0, .02},
        {"shade", "0.1, reflectance 0.5", 1, .25},
        {"corridor", "5 bright rooms", 0, .02},
        {"corridor", "5 bright rooms", 1, .08},
        {"corridor", "5 bright rooms", 2, .3},
        {"sealed", "two bright rooms, 1 and 1e-06", 0, .02},
        {"channel", "1, 1, 1", 0, .02},
        {"sun", "ground and panel", 0, .02},
        {"sphere", "reflectance 0.9, port 1 of a triangle's edge, one emits", 0, .02}};
    constexpr std::uint64_t walks_each = 40'000;
    const double one = sidak(significance, cases.size());
    for (const Case& c : cases) {
        const PreparedScene scene(scene_of(c.family, c.name));
        const HardScene& hard = scene.hard();
        const std::vector<std::uint32_t>& part = hard.parts[c.part];
        const WalkResult walks = walk(scene.mesh(), scene.tracer(), part, walks_each, 2);
        const double right = mean_reflected(hard, part);
        CAPTURE(c.family, c.name, c.part, right, walks.mean, walks.standard_error);
        CHECK(walks.standard_error < c.accuracy * right);
        CHECK(normal_p_value((walks.mean - right) / walks.standard_error) > one);
    }
}

// Stratified shooting is unbiased, and its rays are not those of the references.
TEST_CASE("Shooting agrees with the references wherever its light gets", "[slow]") {
    const Method& method = *find_method("stratified");
    constexpr std::uint64_t runs = 8;
    constexpr double accuracy =
        .03; // of the mean of the runs; elsewhere too few rays arrive, or none
    std::size_t parts = 0;
    for (const HardSceneEntry& e : hard_scenes())
        parts += is_control(e) ? 0 : hard_scene(e).parts.size();
    std::size_t compared = 0;
    for (const HardSceneEntry& e : hard_scenes()) {
        if (is_control(e))
            continue;
        const PreparedScene scene(hard_scene(e));
        std::vector<MeanTest> means(scene.hard().parts.size());
        for (std::uint64_t seed = 1; seed <= runs; ++seed) {
            const Solution solution = shot(scene, method, seed);
            for (std::size_t p = 0; p < means.size(); ++p)
                means[p].add(
                    mean_reflected(scene.hard().scene, solution.radiosity, scene.hard().parts[p]));
        }
        for (std::size_t p = 0; p < means.size(); ++p) {
            const double right = mean_reflected(scene.hard(), scene.hard().parts[p]);
            const double error = means[p].standard_error();
            if (!(error > 0 && error < accuracy * right))
                continue;
            ++compared;
            CAPTURE(e.family, e.name, p, right, means[p].mean(), means[p].standard_error());
            CHECK(means[p].p_value(right) > sidak(significance, parts));
        }
    }
    CHECK(compared > 60);
}

TEST_CASE("The dark room behind a pinhole is as bright as the pinhole is large") {
    const auto dark = [](const char* name) {
        const HardScene& hard = scene_of("pinhole", name);
        return mean_reflected(hard, hard.parts[1]);
    };
    CHECK(dark("0.001, reflectance 0.5") / dark("0.0001, reflectance 0.5") ==
          Approx(100).epsilon(1e-3));
    CHECK(dark("0.0001, reflectance 0.5") / dark("1e-05, reflectance 0.5") ==
          Approx(100).epsilon(1e-3));
    // All light that comes in is absorbed there: sum A B (1 - rho) / rho is the power that falls on
    // the hole, which the factors from the hole to the lit room give.
    constexpr double edge = 1e-4;
    const HardScene& hard = scene_of("pinhole", "0.0001, reflectance 0.5");
    const Polygon hole =
        parallelogram({1, .5 - edge / 2, .5 - edge / 2}, {0, 0, edge}, {0, edge, 0});
    double through = 0;
    for (const std::uint32_t i : hard.parts[0])
        through += hard.reference[i].x * exchange_in_the_open(polygon_of(hard.scene, i), hole);
    CHECK(6 * mean_reflected(hard, hard.parts[1]) == Approx(through).epsilon(1e-4));
}

TEST_CASE("A sphere with a port has the closed form of the spherical cavity") {
    // B = E / (1 - rho (1 - s)) with the port's share s of the sphere. Facets are not quite a
    // sphere, and less so around the port, where four lie in one plane.
    for (const auto& [name, rho, port] :
         {std::tuple{"reflectance 0.9, port 0.1 of a triangle's edge, all emits", .9, .1},
          {"reflectance 0.99, port 0.1 of a triangle's edge, all emits", .99, .1},
          {"reflectance 0.9999, port 0.1 of a triangle's edge, all emits", .9999, .1},
          {"reflectance 0.9999, port 0.01 of a triangle's edge, all emits", .9999, .01}}) {
        const HardScene& hard = scene_of("sphere", name);
        double area = 0;
        for (const std::uint32_t i : hard.parts[0])
            area += polygon_of(hard.scene, i).area();
        // The port's area from the trapezoids around it: their triangle less they are the port.
        double ring = 0;
        for (std::size_t i = 0; i < 3; ++i)
            ring += polygon_of(hard.scene, i).area();
        const double hole = ring * port * port / (1 - port * port);
        const double right = 1 / (1 - rho * (1 - hole / (area + hole)));
        CAPTURE(name, right, hole / (area + hole));
        // The share 1 / 128 of light is somewhat less than even.
        CHECK(mean_reflected(hard, hard.parts[0]) + 1 ==
              Approx(right).epsilon(.05 * (right * hole / area) + 1e-9));
    }
}

TEST_CASE("Sealed rooms have their own light, and channels theirs") {
    // In a closed room of one reflectance sum A B = power / (1 - rho).
    for (const auto& [name, faint] :
         {std::pair{"two rooms, 1 and 0.01", 1e-2}, {"two rooms, 1 and 1e-12", 1e-12}}) {
        const HardScene& hard = scene_of("sealed", name);
        const double power = .05 * .05;
        CHECK(6 * mean_reflected(hard, hard.parts[0]) == Approx(power).epsilon(1e-9));
        CHECK(6 * mean_reflected(hard, hard.parts[1]) == Approx(faint * power).epsilon(1e-9));
    }
    const HardScene& hard = scene_of("channel", "1e-6, 1, 1e-12, bright");
    Vec3 sum(0.0);
    for (std::size_t i = 0; i < hard.reference.size(); ++i)
        sum += polygon_of(hard.scene, i).area() * hard.reference[i];
    CHECK(sum.x == Approx(.05 * .05 * 1e-6 / .1).epsilon(1e-9));
    CHECK(sum.y == Approx(.05 * .05 / .1).epsilon(1e-9));
    CHECK(sum.z == Approx(.05 * .05 * 1e-12 / .1).epsilon(1e-9));
}
