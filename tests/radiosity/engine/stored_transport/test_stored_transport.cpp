// Stored transport: its parts against what they must obey, the whole against the
// reference.
#include "radiosity/engine/emitters/direct_light.h"
#include "radiosity/engine/emitters/small_emitters.h"
#include "radiosity/engine/form_factors/exchange_matrix.h"
#include "radiosity/engine/form_factors/ray_counts.h"
#include "radiosity/engine/linear/conjugate_gradients.h"
#include "radiosity/engine/linear/surfaces.h"
#include "radiosity/engine/saving/state.h"
#include "radiosity/engine/stored_transport/ray_allocation.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"
#include "support/watched_tracer.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <numeric>

using namespace hemilux;
using test::Model;

namespace {

const Method& stored_transport() { return *find_method("stored-transport"); }

/// Sets of rays of all patches, more from some than from others.
std::vector<RayCounts> traced(const Model& model, std::size_t sets, std::uint32_t rays) {
    Monitor monitor;
    std::vector<std::uint32_t> all(model.mesh.patches().size(), rays);
    for (std::size_t i = 0; i < all.size(); i += 3)
        all[i] *= 4;
    std::vector<RayCounts> result;
    for (std::uint64_t s = 0; s < sets; ++s) {
        result.emplace_back(model.mesh, model.bvh, s + 1);
        result.back().trace_up_to(all, Workers(2), monitor);
    }
    return result;
}

/// Relative errors of one run: the true one, and as it is reported.
struct RunErrors {
    double off, reported;

    RunErrors(const Model& model, const Solution& exact, std::uint64_t seed, std::uint32_t steps) {
        SolveOptions options;
        options.seed = seed;
        const Solution s = test::solve(model, stored_transport(), options, test::steps(steps));
        off = true_error(model.mesh, s.radiosity, exact.radiosity).all;
        reported = estimated_error(model.mesh, s);
    }
};

} // namespace

TEST_CASE("Exchange between patches is symmetric, and each row closed") {
    // Where rays are lost, that is known from both sides: rows keep to it as well as their rays
    // tell it, more than two thirds within one standard error and nearly all within three.
    for (const auto& [scene, closed] :
         {std::pair(test::furnace_l_shape(.5), true), std::pair(test::room_with_block(), false),
          std::pair(test::open_scene(), false)}) {
        const Model model(scene);
        const std::size_t n = model.mesh.patches().size();
        const std::vector<RayCounts> sets = traced(model, 2, 32);
        const Workers workers(2);
        const Surfaces at(model.mesh);
        std::vector<ExchangeMatrix> parts;
        for (const RayCounts& set : sets)
            parts.emplace_back(at.area, set);
        const ExchangeMatrix f(std::move(parts), workers);
        std::vector<Vec3> x(n, Vec3(1.0)), y(n);
        f.multiply(x, y, workers);
        double within = 0;
        for (std::uint32_t i = 0; i < n; ++i) {
            const double kept = 1 - f.lost()[i].escaped - f.lost()[i].absorbed;
            const double rays = f.rays()[i], share = (kept * rays + .5) / (rays + 1);
            const double sigma = closed ? 1e-5 : std::sqrt(share * (1 - share) / rays);
            within += std::abs(y[i].x - kept) <= sigma;
            CHECK(std::abs(y[i].x - kept) <= 4 * sigma);
        }
        CHECK(within >= (closed ? 1 : .68) * double(n));
        // x^T A F y = y^T A F x for any two vectors.
        std::vector<Vec3> a(n), b(n), fa(n), fb(n);
        for (std::size_t i = 0; i < n; ++i) {
            a[i] = Vec3(std::sin(double(i)), 1, 0);
            b[i] = Vec3(std::cos(2.0 * double(i)), double(i), 1);
        }
        f.multiply(a, fa, workers);
        f.multiply(b, fb, workers);
        Vec3 left(0.0), right(0.0);
        for (std::uint32_t i = 0; i < n; ++i) {
            left += model.mesh.patches()[i].area * a[i] * fb[i];
            right += model.mesh.patches()[i].area * b[i] * fa[i];
        }
        for (int c = 0; c < 3; ++c)
            CHECK(left[c] == Approx(right[c]).epsilon(1e-13).margin(1e-13));
    }
}

TEST_CASE("Rays are the same whether traced at once or in parts") {
    const Model model(test::room_with_block());
    Monitor monitor;
    const std::vector<std::uint32_t> few(model.mesh.patches().size(), 16);
    const std::vector<std::uint32_t> many(few.size(), 64);
    RayCounts once(model.mesh, model.bvh, 3), parts(model.mesh, model.bvh, 3);
    CHECK(once.trace_up_to(many, Workers(1), monitor) == 64 * few.size());
    parts.trace_up_to(few, Workers(2), monitor);
    CHECK(parts.trace_up_to(many, Workers(2), monitor) == 48 * few.size());
    for (std::uint32_t i = 0; i < few.size(); ++i) {
        CHECK(once.escaped(i) == parts.escaped(i));
        CHECK(std::ranges::equal(once.row(i), parts.row(i)));
    }
}

TEST_CASE("Rays are allocated by weight, in powers of two, and none is taken back") {
    std::vector<double> weights;
    for (int i = 0; i < 1000; ++i)
        weights.push_back(i % 10 == 0 ? 0 : 1e-9 * std::exp(std::sin(7.0 * i)));
    const std::vector<std::uint32_t> none_yet(weights.size(), 0);
    const std::vector<std::uint32_t> rays = allocate_rays(weights, 64, none_yet);
    double sum = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        sum += rays[i];
        CHECK((rays[i] == 0) == (weights[i] == 0));
        CHECK((rays[i] == 0 || std::has_single_bit(rays[i])));
    }
    CHECK(sum / 900 > 48);
    CHECK(sum / 900 <= 64);
    std::vector<double> turned(weights.rbegin(), weights.rend());
    const auto more = allocate_rays(turned, 128, rays);
    for (std::size_t i = 0; i < weights.size(); ++i)
        CHECK((turned[i] == 0 || more[i] >= rays[i]));
    // One that outweighs all others gets what they can spare: they keep an eighth of the mean.
    weights.assign(100, 1e-12);
    weights[7] = 1;
    const auto uneven = allocate_rays(weights, 64, std::vector<std::uint32_t>(100, 0));
    CHECK(uneven[7] == 4096);
    CHECK(uneven[8] >= 8);
}

TEST_CASE("Conjugate gradients end where they are interrupted") {
    const Model model(test::cube_with_lit_floor(2, .5));
    const std::size_t n = model.mesh.patches().size();
    const Workers workers(1);
    const std::vector<RayCounts> sets = traced(model, 1, 64);
    const std::vector<double> area(n, 1.0);
    const ExchangeMatrix f(area, sets[0]);
    const std::vector<Vec3> half(n, Vec3(.5)), d(n, Vec3(1));
    for (const bool stopped : {false, true}) {
        StopFlag flag;
        flag.set_wished(stopped);
        std::vector<Vec3> h(n);
        CHECK((solve_by_gradients(f, area, half, d, h, workers, 1e-9, &flag).iterations == 0) ==
              stopped);
    }
}

TEST_CASE("Conjugate gradients solve what was stored, however reflective") {
    const Model model(test::cube_with_lit_floor(4, .5));
    const std::size_t n = model.mesh.patches().size();
    const Workers workers(1);
    const std::vector<RayCounts> sets = traced(model, 1, 64);
    const std::vector<double> area = Surfaces(model.mesh).area;
    const ExchangeMatrix f(area, sets[0]);
    std::vector<Vec3> d(n);
    std::fill_n(d.begin(), 16, Vec3(1, 0, 1e-20));
    for (const double rho : {0.0, .5, .99, .9999}) {
        const std::vector<Vec3> reflectance(n, Vec3(rho, .3, rho));
        std::vector<Vec3> h(n), reflected(n), fh(n);
        const int iterations =
            solve_by_gradients(f, area, reflectance, d, h, workers, 1e-11).iterations;
        CAPTURE(rho, iterations);
        CHECK(iterations < 60);
        for (std::size_t i = 0; i < n; ++i)
            reflected[i] = reflectance[i] * h[i];
        f.multiply(reflected, fh, workers);
        double sum = 0, most = 0;
        for (std::size_t i = 0; i < n; ++i) {
            sum += h[i].x * area[i] * (1 - rho);
            most = std::max(most, std::abs(h[i].x - d[i].x - fh[i].x));
            CHECK(h[i].y == 0);
            CHECK(h[i].z == Approx(1e-20 * h[i].x));
        }
        CHECK(most < 1e-8 * h[0].x);
        // What is absorbed is what came in: the room is closed.
        CHECK(sum == Approx(16 * area[0]).epsilon(1e-5));
    }
}

TEST_CASE("Patches without rays lose what was guessed of them, and keep no others from an end") {
    const Model model(test::cube_with_lit_floor(8, .5));
    const std::size_t n = model.mesh.patches().size();
    const Workers workers(1);
    Monitor monitor;
    std::vector<std::uint32_t> rays(n);
    for (std::size_t i = 0; i < n / 6; i += 2) // of the first wall, which does not see itself
        rays[i] = 64;
    RayCounts counts(model.mesh, model.bvh, 1);
    counts.trace_up_to(rays, workers, monitor);
    const std::vector<double> area = Surfaces(model.mesh).area;
    const ExchangeMatrix f(area, counts);
    const std::vector<Vec3> half(n, Vec3(.5));
    std::vector<Vec3> d(n), h(n, Vec3(1)), reflected(n), fh(n);
    d[0] = Vec3(1);
    const GradientsResult result = solve_by_gradients(f, area, half, d, h, workers, 1e-9);
    CAPTURE(result.iterations);
    CHECK(result.converged);
    CHECK(result.iterations < 60);
    for (std::size_t i = 0; i < n; ++i)
        reflected[i] = half[i] * h[i];
    f.multiply(reflected, fh, workers);
    double squares = 0, lit = 0, empty = 0;
    for (std::size_t i = 0; i < n; ++i) {
        if (f.row(i).empty()) {
            ++empty;
            CHECK(h[i] == d[i]);
        } else {
            const double off = (h[i].x - d[i].x - fh[i].x) / h[i].x;
            squares += off * off;
            ++lit;
        }
    }
    CHECK(empty > 0);
    CHECK(squares <= 2e-18 * lit); // one more reflection comes after the last residual
}

TEST_CASE("Direct light is unbiased: many emitters, some hidden") {
    Scene scene = test::room_with_block();
    const Model model(scene);
    const std::vector<std::uint32_t> emitters = small_emitters(model.mesh);
    REQUIRE_FALSE(emitters.empty());
    const std::size_t n = model.mesh.patches().size();
    const Workers workers(2);
    Monitor monitor;
    // Against rays at random, which know nothing of emitters.
    const Surfaces at(model.mesh);
    std::vector<Vec3> seen(n);
    std::vector<RayCounts> rays;
    rays.emplace_back(model.mesh, model.bvh, 99);
    rays.back().trace_up_to(std::vector<std::uint32_t>(n, 1u << 14), workers, monitor);
    ExchangeMatrix(at.area, rays[0]).multiply(at.emission, seen, workers);
    DirectLight light(model.mesh, model.bvh, everything_needed, emitters, {5});
    light.sample_up_to(std::vector<std::uint32_t>(n, 1024), workers, monitor);
    double error = 0, value = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
        const double area = model.mesh.patches()[i].area;
        error += area * std::pow(light.irradiance(i).x - seen[i].x, 2);
        value += area * std::pow(seen[i].x, 2);
    }
    CHECK(std::sqrt(error / value) < .03);
}

TEST_CASE("Emitters are small until they are three tenths of all surface") {
    CHECK(small_emitters(Mesh(test::furnace_box(2, .5))).empty());
    CHECK(small_emitters(Mesh(test::cube_with_lit_floor(2, .5))).size() == 4); // a sixth
    CHECK(small_emitters(Mesh(test::furnace_l_shape(.5))).empty());
    CHECK_FALSE(small_emitters(Mesh(test::room_with_block())).empty());
}

TEST_CASE("Stored transport agrees with the matrix and knows its error", "[slow]") {
    for (const Scene& scene : {test::room_with_block(), test::open_scene(),
                               test::cube_with_lit_floor(4, .9), test::furnace_l_shape(.8)}) {
        const Model model(scene);
        const Solution exact = test::reference(model, .0015);
        double log_ratio = 0;
        constexpr int runs = 6;
        for (int run = 0; run < runs; ++run) {
            const RunErrors error(model, exact, 70 + std::uint64_t(run), 5);
            CHECK(error.off < .02);
            log_ratio +=
                std::log(std::hypot(error.reported, .0015) / std::hypot(error.off, 1e-9)) / runs;
        }
        CAPTURE(std::exp(log_ratio));
        CHECK(std::exp(log_ratio) > .8);
    }
}

TEST_CASE("Stored transport finds the light of many emitters that touch a wall") {
    const Model model(test::curtain_at_wall(12));
    const Solution exact = test::reference(model, .003);
    double squares = 0, reported = 0;
    constexpr int runs = 4;
    for (int run = 0; run < runs; ++run) {
        const RunErrors error(model, exact, 80 + std::uint64_t(run), 4);
        squares += error.off * error.off / runs;
        reported += error.reported / runs;
    }
    CAPTURE(std::sqrt(squares), reported);
    CHECK(std::sqrt(squares) < .009);
    CHECK(reported / std::sqrt(squares) > .7);
    CHECK(reported / std::sqrt(squares) < 2.2); // its error has few parts
}

TEST_CASE("Stored transport closes the balance of energy of closed rooms") {
    for (const Scene& scene : {test::room_with_block(), test::cube_with_lit_floor(3, .99)}) {
        const Model model(scene);
        const Solution s = test::solve(model, stored_transport(), {}, test::steps(3));
        for (int c = 0; c < 3; ++c)
            CHECK(s.energy.absorbed[c] + s.energy.escaped[c] ==
                  Approx(s.energy.emitted[c]).epsilon(.01));
    }
}

TEST_CASE("With little memory stored transport goes on, and its rays take no more", "[slow]") {
    const Model model(test::room_with_block());
    const Solution exact = test::reference(model, .004);
    SolveOptions options;
    options.memory = 300'000;
    const Solution few = test::solve(model, stored_transport(), options, test::steps(6));
    const Solution many = test::solve(model, stored_transport(), options, test::steps(40));
    options.memory = 0;
    const Solution free = test::solve(model, stored_transport(), options, test::steps(10));
    CHECK(many.figures.value("bytes_transport") <= 300'000);
    CHECK(many.figures.value("bytes_transport") > few.figures.value("bytes_transport") / 2);
    CHECK(free.figures.value("bytes_transport") > 2 * many.figures.value("bytes_transport"));
    const auto off = [&](const Solution& s) {
        return true_error(model.mesh, s.radiosity, exact.radiosity).all;
    };
    CHECK(off(many) < .6 * off(few));
    CHECK(off(many) < .02);
    CHECK(estimated_error(model.mesh, many) > off(many) / 2);
}

TEST_CASE("A step of stored transport that was interrupted is taken up where it was left") {
    const Model model(test::room_with_block());
    SolveOptions options;
    options.rays = 200;
    options.threads = 2;
    Monitor monitor;
    const auto whole = stored_transport().make({model.mesh, model.bvh, options, monitor});
    for (int step = 0; step < 3; ++step)
        REQUIRE(whole->step());
    for (const int streams : {1, 5, 30}) {
        CAPTURE(streams);
        const test::AfterStreams tracer(model.bvh, streams,
                                        [&] { monitor.interrupted.set_wished(true); });
        const SolverInput input{model.mesh, tracer, options, monitor};
        const auto stopped = stored_transport().make(input);
        while (stopped->step())
            ;
        REQUIRE(monitor.interrupted.own().wished.exchange(false));
        REQUIRE(stopped->solution().steps < 3);
        const auto resumed = stored_transport().make(input);
        test::hand_over(*stopped, *resumed);
        for (Solver* solver : {stopped.get(), resumed.get()}) {
            while (solver->solution().steps < 3)
                REQUIRE(solver->step());
            CHECK(test::same_bits(solver->solution().radiosity, whole->solution().radiosity));
            CHECK(test::same_bits(solver->solution().standard_error,
                                  whole->solution().standard_error));
            CHECK(solver->solution().rays_energy == whole->solution().rays_energy);
        }
    }
}

TEST_CASE("What a large dark patch may have missed does not stay unknown") {
    // A sheet in a closed block under a sky. One ray of the sky stands for much power, so a few
    // rays of the sheet leave most of the error until it gets more.
    Scene scene = test::box_room(Vec3(-1000.0), Vec3(1000.0), 1,
                                 {{"wall", Vec3(.7), Vec3(0.0)}, {"sky", Vec3(0.0), Vec3(1.0)}},
                                 {1, 1, 1, 1, 1, 1});
    test::add_block(scene, Vec3(-6.0), Vec3(6.0));
    test::add_quad(scene, {-5, -5, -5}, {-5, -5, 5}, {5, -5, 5}, {5, -5, -5}, 1, 1, 0);
    const Model model(std::move(scene));
    SolveOptions options;
    options.stop.error = .01;
    StopRule stop;
    stop.error = .01;
    stop.rays = 2'000'000;
    const Solution s = test::solve(model, stored_transport(), options, stop);
    CHECK(s.radiosity.back() == Vec3(0.0));
    CHECK(estimated_error(model.mesh, s) <= .01);
    CHECK(s.rays_energy < 500'000);
}

TEST_CASE("Equal steps take as many rays as were asked for, and an error is reached in few") {
    const Model model(test::room_with_block());
    const auto patches = static_cast<double>(model.mesh.patches().size());
    SolveOptions options;
    options.rays = 100;
    for (const int steps : {1, 2, 5, 9}) {
        options.stop = test::steps(std::uint32_t(steps));
        const Solution s =
            test::solve(model, stored_transport(), options, test::steps(std::uint32_t(steps)));
        CAPTURE(steps);
        CHECK(double(s.rays_energy) / patches < 100 * steps + 1);
        CHECK(double(s.rays_energy) / patches > 60 * steps);
    }
    options.stop = {}; // their number is not known
    const Solution doubled = test::solve(model, stored_transport(), options, test::steps(5));
    CHECK(double(doubled.rays_energy) / patches > 900);
    options.stop.error = .005;
    StopRule stop;
    stop.error = .005;
    const Solution aimed = test::solve(model, stored_transport(), options, stop);
    CHECK(estimated_error(model.mesh, aimed) <= .005);
    CHECK(aimed.steps <= 6);
}
