// The pages of sections 2 and 3.1, which find form factors, and what the page of section 5 has of
// its own: all on the paper's storey alone.
#include "support/catch.h"
#include "support/paper_solve.h"
#include "support/scenes.h"
#include "support/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

using namespace hemilux;
using test::PaperModel;

namespace {

constexpr test::Page matrix{"section 2", plain::matrix};
constexpr test::Page progressive{"section 3.1", plain::progressive};

SolveOptions with_rays(double rays, std::uint64_t seed = 5) {
    SolveOptions options;
    options.rays = rays;
    options.seed = seed;
    return options;
}

/// By the matrix one step; by progressive radiosity, as many as it takes to shoot nearly all.
Solution solve(const PaperModel& model, const test::Page& page, const SolveOptions& options) {
    Monitor monitor;
    const auto solver = page.make({model.mesh, model.bvh, options, monitor});
    do
        REQUIRE(solver->step());
    while (page.make == plain::progressive && !solver->finished());
    return solver->solution();
}

/// The mean over the area, of the green channel.
double mean_radiosity(const Mesh& mesh, const Solution& solution) {
    double sum = 0, area = 0;
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i) {
        sum += mesh.patches()[i].area * solution.radiosity[i].y;
        area += mesh.patches()[i].area;
    }
    return sum / area;
}

/// Two unit squares that face each other at distance 1. The first emits 1; both reflect one half.
Scene two_squares() {
    Scene scene;
    scene.materials.push_back({"lamp", Vec3(.5), Vec3(1.0)});
    scene.materials.push_back({"wall", Vec3(.5), Vec3(0.0)});
    test::add_quad(scene, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 1, 1, 0);
    test::add_quad(scene, {0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}, 1, 1, 1);
    return scene;
}

} // namespace

TEST_CASE("The full matrix keeps a furnace exactly, patch by patch") {
    // Each row of factors sums to 1, whatever the rays have hit.
    const PaperModel model(test::furnace_l_shape(.8));
    double largest = 0;
    for (const Vec3& B : solve(model, matrix, with_rays(16)).radiosity)
        largest = std::max(largest, glm::length(B - Vec3(5.0)));
    CHECK(largest < 1e-9);
}

TEST_CASE("Progressive radiosity shoots all of a furnace but a little") {
    const PaperModel model(test::furnace_box(3, .5));
    const Solution solution = solve(model, progressive, with_rays(32));
    CHECK(mean_radiosity(model.mesh, solution) == Approx(2).epsilon(.005));
    CHECK(solution.energy.unshot.y <= 1e-4 * solution.energy.emitted.y);
    for (const Vec3& B : solution.radiosity)
        CHECK(B.y == Approx(2).epsilon(.2));
}

TEST_CASE("Two squares that face each other, by the matrix and by progressive radiosity") {
    constexpr double F = .19982490, rho = .5; // Howell, C-11
    const std::array<double, 2> exact{1 / (1 - rho * rho * F * F),
                                      rho * F / (1 - rho * rho * F * F)};
    const PaperModel model(two_squares());
    for (const test::Page& page : {matrix, progressive}) {
        CAPTURE(page.name);
        test::MeanTest lamp, wall;
        double reported = 0;
        constexpr int runs = 16;
        for (std::uint64_t seed = 1; seed <= runs; ++seed) {
            const Solution s = solve(model, page, with_rays(4000, seed));
            lamp.add(s.radiosity[0].y);
            wall.add(s.radiosity[1].y);
            reported += s.standard_error[1].y * s.standard_error[1].y / runs;
        }
        CHECK(lamp.p_value(exact[0]) > test::sidak(test::significance, 4));
        CHECK(wall.p_value(exact[1]) > test::sidak(test::significance, 4));
        const double spread = wall.standard_error() * std::sqrt(double(runs));
        CHECK(std::sqrt(reported) > .5 * spread);
        CHECK(std::sqrt(reported) < 2 * spread);
    }
}

TEST_CASE("What is emitted is absorbed, escapes, or is unshot or chance") {
    const PaperModel model(test::open_scene());
    for (const auto& [page, rays] :
         {std::pair{matrix, 4096.0}, std::pair{matrix, 8.0}, std::pair{progressive, 4.0}}) {
        CAPTURE(page.name, rays);
        const Solution s = solve(model, page, with_rays(rays));
        CHECK(s.energy.imbalance() < 1e-9);
        CHECK(s.energy.escaped.y > 0);
        CHECK(s.energy.absorbed.y > 0);
        if (rays != 8.0) // the matrix's factors fit together with many rays alone
            CHECK(std::abs(s.energy.unshot.y) < .1 * s.energy.emitted.y);
    }
}

TEST_CASE("The matrix and progressive radiosity report their errors") {
    const PaperModel model(test::room_with_block());
    const Solution reference = test::solve_page(model, test::pages_of_steps[1], with_rays(256), 8);
    for (const auto& [page, rays] : {std::pair{matrix, 128.0}, std::pair{progressive, 2.0}}) {
        CAPTURE(page.name);
        constexpr int runs = 4;
        double squares = 0, reported = 0;
        for (std::uint64_t seed = 1; seed <= runs; ++seed) {
            const Solution s = solve(model, page, with_rays(rays, seed));
            const double off = true_error(model.mesh, s.radiosity, reference.radiosity).all;
            const double error = estimated_error(model.mesh, s);
            squares += off * off;
            reported += error * error;
        }
        CAPTURE(std::sqrt(squares / runs), std::sqrt(reported / runs));
        CHECK(std::sqrt(squares / reported) > .6);
        CHECK(std::sqrt(squares / reported) < 1.5);
    }
}

TEST_CASE("Each shot leaves less unshot, and the ambient term shows what it is") {
    const PaperModel model(test::room_with_block());
    const auto first_images = [&](bool ambient) {
        const SolveOptions options = with_rays(16);
        Monitor monitor;
        const auto solver = plain::progressive({model.mesh, model.bvh, options, monitor}, ambient);
        std::vector<double> means;
        double unshot = solver->solution().energy.unshot.y;
        for (int shot = 0; shot < 20; ++shot) {
            REQUIRE(solver->step());
            means.push_back(mean_radiosity(model.mesh, solver->solution()));
            CHECK(solver->solution().energy.unshot.y < unshot);
            unshot = solver->solution().energy.unshot.y;
        }
        return means;
    };
    const std::vector<double> without = first_images(false), with = first_images(true);
    CHECK(std::ranges::is_sorted(without));
    for (std::size_t shot = 0; shot < without.size(); ++shot)
        CHECK(with[shot] > without[shot]);
    CHECK(with.back() - without.back() < with.front() - without.front());
}

TEST_CASE("The full matrix refuses more patches than it keeps pairs of") {
    const PaperModel model(test::furnace_box(19, .5)); // 6 * 19 * 19 patches
    REQUIRE(model.mesh.patches().size() > plain::max_patches_of_matrix);
    const SolveOptions options;
    Monitor monitor;
    CHECK_THROWS_AS(plain::matrix({model.mesh, model.bvh, options, monitor}),
                    std::invalid_argument);
}

TEST_CASE("The paper's procedure goes on until the image is useful") {
    const PaperModel model(test::room_with_block());
    const SolveOptions options = with_rays(8);
    Monitor monitor;
    const SolverInput scene{model.mesh, model.bvh, options, monitor};
    const auto useful = [](const Solution& image) { return image.steps == 3; };
    const Solution image = plain::new_hemisphere_radiosity(scene, useful);
    CHECK(image.steps == 3);
    CHECK(image.radiosity ==
          test::solve_page(model, test::pages_of_steps[3], options, 3).radiosity);
    monitor.interrupted.set_wished(true);
    CHECK(plain::new_hemisphere_radiosity(scene, useful).steps == 0);
}

TEST_CASE("Triangles share the line of their patch's rays, and none is left out") {
    const plain::Due due{.patch = 0, .key = 0, .begin = .25, .end = 100.75};
    const double dim = 1e-12; // of all rays
    CHECK(plain::rays_on_line(due, 0, .5).number + plain::rays_on_line(due, .5, .5 + dim).number +
              plain::rays_on_line(due, .5 + dim, 1).number ==
          100);
    CHECK(plain::rays_on_line(due, .5, .5).number == 0);
    CHECK(plain::rays_on_line(due, .5, .5 + dim).divisor > 0); // rare, and carries the more
    CHECK(plain::rays_on_line(due, .5, .5 + dim).divisor < 1e-4);
}
