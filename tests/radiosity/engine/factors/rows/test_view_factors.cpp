// What view factors promise: errors that hold against brute force, rows that sum to 1, the same
// bytes whatever the threads.
#include "bvh/wide/shaft.h"
#include "geometry/polygon_sampler.h"
#include "radiosity/engine/factors/pairs/free_exchange.h"
#include "radiosity/engine/factors/pairs/line_samples.h"
#include "radiosity/engine/factors/pairs/pair_hull.h"
#include "radiosity/engine/factors/rows/view_factors.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/solver.h"
#include "support/bare_scene.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace hemilux;

namespace {

/// Blocks of different heights on a ground of 8 x 8 facets.
Scene small_city() {
    Scene scene = test::bare_scene();
    test::add_quad(scene, {0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}, 8, 8, 0);
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) {
            const Vec3 low(.8 + 2.5 * i, .7 + 2.6 * k, 0);
            test::add_block(scene, low, low + Vec3(1.3, 1.4, .7 + .6 * ((i + 2 * k) % 4)));
        }
    return scene;
}

struct City {
    test::Model model{small_city()};
    std::vector<std::uint32_t> row_of;

    City() {
        row_of.resize(model.mesh.patches().size());
        std::iota(row_of.begin(), row_of.end(), 0u);
    }
    [[nodiscard]] ViewFactors factors(const ExchangeOptions& options = {},
                                      unsigned threads = 2) const {
        Monitor monitor;
        return view_factors(model.mesh, model.bvh, row_of, row_of.size(), options, Workers(threads),
                            monitor);
    }
};

/// The kernel between two patches by plain random points and rays that test all facets, without
/// the shafts, lines and contours of what is tested.
OpenShare by_brute_force(const test::Model& model, std::uint32_t i, std::uint32_t j, int rays) {
    const Patch &a = model.mesh.patches()[i], &b = model.mesh.patches()[j];
    const PolygonSampler of_a(a.shape), of_b(b.shape);
    Rng random(hash_words({7, i, j}));
    double sum = 0, squares = 0;
    for (int k = 0; k < rays; ++k) {
        const double u[] = {random.uniform(), random.uniform(), random.uniform(), random.uniform()};
        const Vec3 x = of_a.sample({u[0], u[1]}), y = of_b.sample({u[2], u[3]}), d = y - x;
        const double square = glm::dot(d, d);
        double kernel = std::max(0.0, glm::dot(d, a.normal)) *
                        std::max(0.0, -glm::dot(d, b.normal)) /
                        (square * square * std::numbers::pi) * b.area;
        if (kernel > 0 && model.bvh.occluded({x, d, 1 - 1e-12, 1e-13, a.facet}, b.facet))
            kernel = 0;
        sum += kernel;
        squares += kernel * kernel;
    }
    const double mean = sum / rays;
    return {mean, std::sqrt(std::max(squares / rays - mean * mean, 0.0) / rays)};
}

} // namespace

TEST_CASE("View factors are within their errors of brute force") {
    const City city;
    const ViewFactors factors = city.factors();
    Rng random(5);
    int pairs = 0, partly = 0, within_two = 0;
    double squares = 0;
    while (pairs < 60) {
        const auto i = static_cast<std::uint32_t>(random.uniform() * double(factors.rows()));
        const std::size_t begin = factors.row_begin[i], end = factors.row_begin[i + 1];
        if (begin == end)
            continue;
        const auto k = begin + static_cast<std::size_t>(random.uniform() * double(end - begin));
        const bool exact = factors.standard_error[k] == 0;
        if (factors.factor[k] < 1e-3 || (exact && pairs - partly >= 20))
            continue;
        const OpenShare truth = by_brute_force(city.model, i, factors.column[k], 4000);
        const double error = std::hypot(truth.standard_error, factors.standard_error[k]);
        const double z = (factors.factor[k] - truth.factor) / error;
        CHECK(std::abs(z) < 4.5); // 60 pairs, one in 100 000 by chance each
        ++pairs;
        partly += !exact;
        within_two += std::abs(z) < 2;
        squares += z * z;
    }
    CHECK(partly >= 40);
    CHECK(within_two >= 52);
    CHECK(std::sqrt(squares / pairs) < 1.3);
}

TEST_CASE("View factors are closed, reciprocal and not negative") {
    const City city;
    const ViewFactors factors = city.factors();
    for (std::uint32_t i = 0; i < factors.rows(); ++i) {
        CHECK(factors.row_sum(i) == Approx(1).margin(1e-12));
        CHECK(factors.unlisted_bound[i] < .02);
        for (const OpenShare& open : factors.open[i])
            CHECK((open.factor >= 0 && open.factor <= 1));
    }
    for (const double factor : factors.factor)
        CHECK((factor > 0 && factor <= 1));
    CHECK(worst_reciprocity(factors) < 1e-12);
    CHECK(factors.audit.chance_rms < 1.4);
    CHECK(factors.audit.largest_exact_move < 1e-8);
    CHECK(errors_above(factors, 1e-3).rms < .01);
    CHECK(errors_above(factors, 1e-3).factors > 1000);
}

TEST_CASE("View factors have the same bytes for any number of threads, others for another seed") {
    const City city;
    const ExchangeOptions options{.rays = 256, .tolerance = relative_above(.05, 1e-2)};
    const ViewFactors one = city.factors(options, 1), three = city.factors(options, 3);
    CHECK(one.column == three.column);
    CHECK(one.factor == three.factor);
    CHECK(one.standard_error == three.standard_error);
    ExchangeOptions other = options;
    other.seed = 2;
    CHECK(city.factors(other).factor != one.factor);
}

TEST_CASE("A smaller error is asked for and reached") {
    const City city;
    const auto rms = [&](double error) {
        const FactorErrors errors =
            errors_above(city.factors({.tolerance = relative_above(error, .01)}), .01);
        return errors.rms;
    };
    CHECK(rms(.05) < .05);
    CHECK(rms(.005) < .0075);
}

TEST_CASE("The escaped share is sky above and ground below") {
    Scene scene = test::bare_scene();
    test::add_quad(scene, {0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}, 1, 1, 0);
    const test::Model model(std::move(scene));
    Monitor monitor;
    const std::vector<std::uint32_t> row_of{0};
    for (const int up : {1, 2}) {
        const ViewFactors factors =
            view_factors(model.mesh, model.bvh, row_of, 1, {.up = up}, Workers(1), monitor);
        const auto& [sky, ground, back] = factors.open[0];
        CHECK(sky.factor == Approx(.5).margin(3 * sky.standard_error));
        CHECK(sky.factor + ground.factor == Approx(1).margin(1e-12));
        CHECK(back.factor == 0);
    }
}

TEST_CASE("Long strips that no ray of each other hit are found by rays between them") {
    for (const double length : {100.0, 1e4, 1e6})
        for (std::uint64_t seed = 1; seed <= 5; ++seed) {
            Scene street = test::bare_scene(); // 30 m wide between walls, each of ten strips
            constexpr int strips = 10;
            test::add_quad(street, {0, 0, 0}, {30, 0, 0}, {30, length, 0}, {0, length, 0}, strips,
                           1, 0);
            test::add_quad(street, {0, 0, 15}, {0, 0, 0}, {0, length, 0}, {0, length, 15}, strips,
                           1, 0);
            test::add_quad(street, {30, 0, 0}, {30, 0, 15}, {30, length, 15}, {30, length, 0},
                           strips, 1, 0);
            const test::Model model(street);
            REQUIRE(model.mesh.patches().size() == 3 * strips);
            std::vector<std::uint32_t> row_of(3 * strips);
            std::iota(row_of.begin(), row_of.end(), 0u);
            Monitor monitor;
            const ViewFactors factors =
                view_factors(model.mesh, model.bvh, row_of, row_of.size(),
                             {.rays = 256, .seed = seed}, Workers(1), monitor);
            CHECK(factors.work.exact_pairs == 3 * strips * strips);
            CHECK(factors.factor.size() == 6 * strips * strips);
        }
}

TEST_CASE("What falls on backs is neither lost nor counted as sky") {
    Scene scene = test::bare_scene();
    test::add_quad(scene, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 1, 1, 0);
    test::add_quad(scene, {-9, -9, .1}, {9, -9, .1}, {9, 9, .1}, {-9, 9, .1}, 1, 1, 0); // its back
    const test::Model model(std::move(scene));
    Monitor monitor;
    const std::vector<std::uint32_t> row_of{0, 1};
    const ViewFactors factors =
        view_factors(model.mesh, model.bvh, row_of, 2, {}, Workers(1), monitor);
    CHECK(factors.factor.empty());
    CHECK(factors.open[0][2].factor > .99);
    CHECK(factors.row_sum(0) == Approx(1).margin(1e-12));
}

TEST_CASE("A hull holds exactly what lies between") {
    const Polygon floor{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}};
    Polygon ceiling = floor.flipped();
    for (Vec3& corner : ceiling.corner)
        corner += Vec3(2, 0, 1);
    const FacePlane a = face_plane(floor), b = face_plane(ceiling);
    const PairHull hull(part_of(floor), a.plane, part_of(ceiling), b.plane, 1e-9);
    const auto small_at = [&](const Vec3& place) {
        Polygon polygon = floor;
        for (Vec3& corner : polygon.corner)
            corner = .1 * corner + place;
        return polygon;
    };
    CHECK(hull.holds_some_of(small_at({1.5, .5, .5})));
    CHECK_FALSE(hull.holds_some_of(small_at({.2, .5, .5})));    // left of the slanted side
    CHECK_FALSE(hull.holds_some_of(small_at({1.5, 1.01, .5}))); // beside
    CHECK_FALSE(hull.holds_some_of(small_at({.5, .5, 0})));     // in the plane of one
    CHECK_FALSE(hull.holds_some_of(small_at({.5, .5, -.2})));   // behind it
    CHECK_FALSE(hull.holds_some_of(small_at({2.2, .5, 1.01})));
}

TEST_CASE("A tree finds every facet that reaches into a hull") {
    const City city;
    const auto patches = city.model.mesh.patches();
    Rng random(3);
    std::vector<std::uint32_t> found;
    std::size_t inside = 0;
    for (int k = 0; k < 300; ++k) {
        const auto any = [&] {
            return static_cast<std::uint32_t>(random.uniform() * double(patches.size()));
        };
        const FacePlane a = face_plane(patches[any()].shape), b = face_plane(patches[any()].shape);
        if (facing(a, b, 1e-9) != Facing::wholly)
            continue;
        const PairHull hull(part_of(a.shape), a.plane, part_of(b.shape), b.plane, 1e-9);
        found.clear();
        city.model.bvh.facets_within(hull.sides(), found);
        CHECK(std::ranges::is_sorted(found));
        for (std::uint32_t f = 0; f < patches.size(); ++f)
            if (hull.holds_some_of(city.model.mesh.shape_of(f))) {
                ++inside;
                CHECK(std::ranges::binary_search(found, f));
            }
    }
    CHECK(inside > 100);
}

TEST_CASE("Free exchange by areas is that by contours") {
    Rng random(11);
    const auto in_box = [&] {
        return Vec3(random.uniform(), random.uniform(), random.uniform()) - .5;
    };
    for (int k = 0; k < 400; ++k) {
        const auto polygon = [&](const Vec3& centre) {
            const Vec3 u = in_box(), v = glm::cross(u, in_box());
            return Polygon{{centre - u - v, centre + u - v, centre + u + v, centre - u + v}};
        };
        const Vec3 direction = glm::normalize(in_box());
        const FacePlane a = face_plane(polygon(Vec3(0.0))),
                        b = face_plane(polygon((1.5 + 20 * random.uniform()) * direction));
        if (facing(a, b, 1e-12) != Facing::wholly)
            continue;
        const double smaller = std::min(a.area, b.area);
        const double contour = exchange_area(a.shape, b.shape);
        CHECK(free_exchange(a, b, Facing::wholly, FreeAccuracy::exact, 1e-12) ==
              Approx(contour).margin(3e-10 * smaller).epsilon(0));
        CHECK(free_exchange(a, b, Facing::wholly, FreeAccuracy::rough, 1e-12) ==
              Approx(contour).epsilon(2e-3).margin(1e-8 * smaller));
    }
}

TEST_CASE("Lines that all see the other are exact, and their error says that they are few") {
    const Polygon floor{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}};
    Polygon ceiling = floor.flipped();
    for (Vec3& corner : ceiling.corner)
        corner.z = 1;
    const FacePlane a = face_plane(floor), b = face_plane(ceiling);
    LineSamples free(a, b, {}, LinesAlong::first_edge, 1);
    free.go_on_to(LineSamples::first_lines);
    const SeenShare few = free.seen();
    free.go_on_to(256);
    const SeenShare many = free.seen();
    CHECK(many.lines == 256);
    CHECK(few.share == 1);
    CHECK(few.clear_lines == few.lines);
    CHECK(few.variance > 0);
    CHECK(many.variance < few.variance);
}

TEST_CASE("The errors of lines past slats hold, along them and across, for few and many lines") {
    Rng random(5);
    std::vector<double> errors;
    double squares = 0;
    for (int layout = 0; layout < 60; ++layout) {
        const Polygon floor{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}};
        Polygon ceiling = floor.flipped();
        for (Vec3& corner : ceiling.corner)
            corner += Vec3(random.uniform(), 0, .7 + random.uniform());
        std::vector<Polygon> slats;
        const int count = 2 + static_cast<int>(20 * random.uniform());
        const double pitch = 3.0 / count, height = .1 + .5 * random.uniform(),
                     tilt = 1.4 * random.uniform(), slant = .4 * random.uniform();
        const Vec3 half =
            (.1 + .3 * random.uniform()) * pitch * Vec3(std::cos(tilt), 0, std::sin(tilt));
        for (int k = 0; k < count; ++k) {
            const Vec3 from(pitch * k - .5, -.5, height), to(pitch * k - .5 + slant, 1.5, height);
            slats.push_back({{from - half, from + half, to + half, to - half}});
        }
        const FacePlane a = face_plane(floor), b = face_plane(ceiling);
        for (const LinesAlong along : {LinesAlong::first_edge, LinesAlong::second_edge}) {
            LineSamples truth(a, b, slats, along, 99);
            truth.go_on_to(1 << 14);
            for (std::uint64_t seed = 1; seed <= 6; ++seed) {
                LineSamples lines(a, b, slats, along, seed);
                for (const std::uint32_t lines_now : {16u, 64u, 256u}) {
                    lines.go_on_to(lines_now);
                    const SeenShare seen = lines.seen();
                    const double error = std::sqrt(seen.variance + truth.seen().variance);
                    errors.push_back(std::abs(seen.share - truth.seen().share) / error);
                    squares += errors.back() * errors.back();
                }
            }
        }
    }
    const double all = double(errors.size());
    const auto beyond = [&](double z) {
        return double(std::ranges::count_if(errors, [z](double x) { return x > z; })) / all;
    };
    CHECK(all == 60 * 2 * 6 * 3);
    CAPTURE(std::sqrt(squares / all), beyond(2), beyond(3.5));
    CHECK(std::sqrt(squares / all) < 1.1);
    CHECK(std::sqrt(squares / all) > .35); // nor are they far too large
    CHECK(beyond(2) < .05);
    CHECK(beyond(3.5) < .01);
}
