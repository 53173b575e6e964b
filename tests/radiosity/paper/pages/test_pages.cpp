// The pages in rooms whose light is known, and the rules that each of them must keep.
#include "bvh/brute_force.h"
#include "support/catch.h"
#include "support/closed_forms.h"
#include "support/guided_rays.h"
#include "support/paper_solve.h"
#include "support/scenes.h"

#include <cmath>

using namespace hemilux;
using test::Page;
using test::pages_of_steps;
using test::PaperModel;
using test::solve_page;

namespace {

/// Sums over patches: the mean of a channel by area, and its standard error if patches err
/// independently.
struct Mean {
    double value = 0, sigma = 0;
};

Mean mean_of(const Mesh& mesh, const Solution& s, int channel) {
    double area = 0, sum = 0, variance = 0;
    for (std::size_t i = 0; i < s.radiosity.size(); ++i) {
        const double a = mesh.patches()[i].area;
        area += a;
        sum += a * s.radiosity[i][channel];
        variance += std::pow(a * s.standard_error[i][channel], 2);
    }
    return {sum / area, std::sqrt(variance) / area};
}

/// A grey square, and over it a lamp of its size.
Scene opposed_squares() {
    Scene scene;
    scene.materials = {{"floor", Vec3(.5), Vec3(0.0)}, {"lamp", Vec3(0.0), Vec3(1.0)}};
    scene.groups = {"all"};
    test::add_quad(scene, {0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}, 1, 1, 0);
    test::add_quad(scene, {0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}, 1, 1, 1);
    return scene;
}

} // namespace

TEST_CASE("Every page finds E / (1 - rho) in a furnace, on each patch") {
    for (const Scene& scene : {test::furnace_box(2, .5), test::furnace_l_shape(.5)}) {
        const PaperModel model(scene);
        for (const Page& page : pages_of_steps) {
            CAPTURE(page.name);
            const Solution s = solve_page(model, page, {.rays = 32}, 24);
            double squares = 0;
            for (std::size_t i = 0; i < s.radiosity.size(); ++i) {
                const double z = (s.radiosity[i].x - 2) / s.standard_error[i].x;
                CHECK(std::abs(z) < 6);
                squares += z * z / double(s.radiosity.size());
            }
            CHECK(squares > .5);
            CHECK(squares < 2); // standard errors are what they say
            CHECK(s.energy.escaped == Vec3(0.0));
            CHECK(s.energy.absorbed.x == Approx(s.energy.emitted.x).epsilon(.01));
            CHECK(s.steps == 24);
        }
    }
}

TEST_CASE("Every page finds the form factor of opposed squares") {
    const PaperModel model(opposed_squares());
    const double factor = test::opposed_rectangles(1, 1), exact = .5 * factor;
    for (const Page& page : pages_of_steps) {
        CAPTURE(page.name);
        const Solution s = solve_page(model, page, {.rays = 4000}, 8);
        CHECK(s.energy.escaped.x == Approx((1 - factor) * (1 + exact)).epsilon(.02));
        CHECK(s.radiosity[0].x == Approx(exact).margin(5 * s.standard_error[0].x));
        CHECK(s.standard_error[0].x < .02 * exact);
        CHECK(s.radiosity[1] == Vec3(1.0));
    }
}

TEST_CASE("Pages agree with each other where things stand in each other's way") {
    const PaperModel model(test::room_with_block());
    const Solution first = solve_page(model, pages_of_steps[0], {.rays = 32}, 16);
    for (const Page& page : {pages_of_steps[1], pages_of_steps[2], pages_of_steps[3]}) {
        const Solution s = solve_page(model, page, {.rays = 32, .seed = 5}, 16);
        double squares = 0, count = 0;
        for (std::size_t i = 0; i < s.radiosity.size(); ++i)
            for (int c = 0; c < 3; ++c) {
                const double sigma = std::hypot(s.standard_error[i][c], first.standard_error[i][c]);
                if (!(sigma > 0) || s.hits[i] < 100)
                    continue;
                squares += std::pow((s.radiosity[i][c] - first.radiosity[i][c]) / sigma, 2);
                ++count;
            }
        CAPTURE(page.name, count, squares / count);
        REQUIRE(count > 100);
        CHECK(squares / count < 1.5);
        for (int c = 0; c < 3; ++c) {
            const Mean a = mean_of(model.mesh, first, c), b = mean_of(model.mesh, s, c);
            CHECK(std::abs(a.value - b.value) < .03 * a.value);
        }
    }
}

TEST_CASE("The printed rules break the cosine law, the corrected ones do not") {
    const PaperModel model(opposed_squares());
    const double exact = .5 * test::opposed_rectangles(1, 1);
    for (const Page& page : pages_of_steps) {
        if (!page.has_literal)
            continue;
        const auto off = [&](bool literal) {
            const Solution s = solve_page(model, page, {.rays = 8000, .literal = literal}, 4);
            return std::abs(s.radiosity[0].x / exact - 1);
        };
        CAPTURE(page.name);
        CHECK(off(false) < .02);
        CHECK(off(true) > .1);
    }
}

TEST_CASE("A page does not depend on the tracer, and does on the seed") {
    const Mesh mesh(test::room_with_block());
    const Bvh bvh(mesh.soup());
    const BruteForce brute(mesh.soup());
    for (const Page& page : pages_of_steps) {
        CAPTURE(page.name);
        const SolveOptions options{.rays = 4};
        const Solution a = solve_page(mesh, bvh, page, options, 2),
                       b = solve_page(mesh, brute, page, options, 2),
                       c = solve_page(mesh, bvh, page, {.rays = 4, .seed = 2}, 2);
        CHECK(a.radiosity == b.radiosity);
        CHECK(a.rays_energy == b.rays_energy);
        CHECK(a.radiosity != c.radiosity);
        CHECK((a.rays_density > 0) == page.has_densities);
    }
}

TEST_CASE("A page shoots about as many rays as were asked for") {
    const PaperModel model(test::room_with_block());
    for (const Page& page : pages_of_steps) {
        const Solution s = solve_page(model, page, {.rays = 32}, 8);
        const double asked = 32.0 * 8 * double(model.mesh.patches().size());
        CAPTURE(page.name);
        CHECK(double(s.rays_energy) == Approx(asked).epsilon(.15)); // and the pilot's
    }
}

// As engine/densities/test_least_density.cpp says of the engine.
TEST_CASE("No ray of section 5 carries more than five times the mean") {
    const double share = test::share_away_from_crowd(plain::hemisphere);
    CHECK(share > test::power_away_from_crowd / 5);
    CHECK(share < test::power_away_from_crowd / 2);
}
