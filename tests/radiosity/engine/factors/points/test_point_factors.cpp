// View factors from points: closed forms, brute force, sums.
#include "geometry/frame.h"
#include "radiosity/engine/factors/points/point_factors.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/solver.h"
#include "support/bare_scene.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

using namespace hemilux;

namespace {

/// A scene whose surfaces are its patches.
struct Rows {
    test::Model model;
    std::vector<std::uint32_t> row_of;

    explicit Rows(Scene scene) : model(std::move(scene)), row_of(model.mesh.patches().size()) {
        std::iota(row_of.begin(), row_of.end(), 0u);
    }
    [[nodiscard]] FactorPoint at(const Vec3& world, const Vec3& normal) const {
        return {model.mesh.frame().to_local(world), glm::normalize(normal), none};
    }
    [[nodiscard]] PointFactors row(const FactorPoint& point,
                                   const PointFactorOptions& options = {}) const {
        Monitor monitor;
        return point_factors({&point, 1}, model.mesh, model.bvh, row_of, options, Workers(1),
                             monitor)
            .front();
    }
};

double between(const PointFactors& row, std::uint32_t column) {
    const auto at = std::ranges::find(row.column, column);
    return at == row.column.end() ? 0
                                  : row.factor[static_cast<std::size_t>(at - row.column.begin())];
}

/// From a point to a rectangle a x b that is parallel to its facet at the height c, one corner
/// being above the point (Howell's catalogue, B-3).
double to_rectangle_above(double a, double b, double c) {
    const double x = a / c, y = b / c, p = std::sqrt(1 + x * x), q = std::sqrt(1 + y * y);
    return (x / p * std::atan(y / p) + y / q * std::atan(x / q)) / (2 * std::numbers::pi);
}

/// From a point to a rectangle that stands perpendicular to its facet at the distance c, a high
/// and b wide, one lower corner being nearest (Howell's catalogue, B-4).
double to_rectangle_beside(double a, double b, double c) {
    const double y = b / c, x = a / c, r = std::sqrt(1 + x * x);
    return (std::atan(y) - std::atan(y / r) / r) / (2 * std::numbers::pi);
}

/// Shares of plain random rays by surface, then sky, ground and backs.
std::map<std::uint32_t, double> by_rays(const Rows& rows, const FactorPoint& point, int count) {
    const Frame frame = Frame::from_normal(point.normal);
    Rng random(11);
    std::map<std::uint32_t, double> shares;
    for (int k = 0; k < count; ++k) {
        const Ray ray{.origin = point.position,
                      .direction = frame.to_world(sample_cosine(random)),
                      .from = point.facet};
        const auto hit = rows.model.bvh.closest(ray);
        const auto n = static_cast<std::uint32_t>(rows.row_of.size());
        std::uint32_t column = ray.direction.z > 0 ? n : n + 1;
        if (hit) {
            column = rows.model.mesh.patch_at(*hit);
            column = column == none ? n + 2 : column;
        }
        shares[column] += 1.0 / count;
    }
    return shares;
}

/// Blocks of different heights on a ground of 6 x 6 facets, and a roof that shows its back.
Scene blocks() {
    Scene scene = test::bare_scene();
    test::add_quad(scene, {0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}, 6, 6, 0);
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) {
            const Vec3 low(.8 + 2.5 * i, .7 + 2.6 * k, 0);
            test::add_block(scene, low, low + Vec3(1.3, 1.4, .7 + .6 * ((i + 2 * k) % 4)));
        }
    test::add_quad(scene, {2, 2, 3}, {5, 2, 3}, {5, 5, 3.2}, {2, 5, 3.2}, 1, 1, 0);
    return scene;
}

} // namespace

TEST_CASE("A point sees a rectangle above its corner and one beside it by their closed forms") {
    Scene scene = test::bare_scene();
    test::add_quad(scene, {0, 0, 2}, {0, 3, 2}, {5, 3, 2}, {5, 0, 2}, 1, 1, 0);
    test::add_quad(scene, {-4, 0, 0}, {-4, 6, 0}, {-4, 6, 1.5}, {-4, 0, 1.5}, 1, 1, 0);
    const Rows rows(std::move(scene));
    const PointFactors row = rows.row(rows.at({0, 0, 0}, {0, 0, 1}));
    CHECK(between(row, 0) == Approx(to_rectangle_above(5, 3, 2)).epsilon(1e-12));
    CHECK(between(row, 1) == Approx(to_rectangle_beside(1.5, 6, 4)).epsilon(1e-12));
    CHECK(row.standard_error == std::vector<double>{0, 0});
    const auto& [sky, ground, back] = row.open;
    CHECK(sky.factor == Approx(1 - between(row, 0) - between(row, 1)).epsilon(1e-12));
    CHECK(sky.standard_error == 0);
    CHECK((ground.factor == 0 && back.factor == 0 && row.unlisted_bound == 0));
}

TEST_CASE("A point in a closed cube sees its sides alone, at any tilt") {
    const Rows rows(test::box_room({0, 0, 0}, {1, 1, 1}, 1, {Material{}}, {}));
    const PointFactors middle = rows.row(rows.at({.5, .5, .5}, {0, 1, 0}));
    CHECK(between(middle, 1) == Approx(4 * to_rectangle_above(.5, .5, .5)).epsilon(1e-12));
    for (std::uint32_t side = 2; side < 6; ++side)
        CHECK(between(middle, side) == Approx(2 * to_rectangle_beside(.5, .5, .5)).epsilon(1e-12));
    Rng random(3);
    for (int k = 0; k < 50; ++k) {
        const auto any = [&] { return Vec3(random.uniform(), random.uniform(), random.uniform()); };
        const PointFactors row = rows.row(rows.at(.1 + .8 * any(), any() - .5));
        double sum = 0;
        for (const double factor : row.factor)
            sum += factor;
        CHECK(sum == Approx(1).margin(1e-12));
        CHECK(row.sum() == Approx(1).margin(1e-12));
        for (const OpenShare& open : row.open)
            CHECK((open.factor == 0 && open.standard_error == 0));
    }
}

TEST_CASE("A vertical point above nothing sees sky and ground by halves, a tilted one unlike") {
    Scene scene = test::bare_scene();
    test::add_quad(scene, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 1, 1, 0);
    const Rows rows(std::move(scene));
    const PointFactors wall = rows.row(rows.at({.5, .5, -1}, {1, 0, 0}));
    const auto& [sky, ground, back] = wall.open;
    CHECK(back.factor > .01); // the square from below
    CHECK(sky.factor == Approx(.5 - back.factor).epsilon(1e-12));
    CHECK(ground.factor == Approx(.5).epsilon(1e-12));
    const PointFactors tilted = rows.row(rows.at({.5, .5, .5}, {0, std::sqrt(3.), 1}));
    CHECK(tilted.open[0].factor == Approx(.75).epsilon(1e-12));
    CHECK(tilted.sum() == Approx(1).margin(1e-14));
}

TEST_CASE("What stands between is cut out exactly") {
    Scene scene = test::bare_scene();
    test::add_quad(scene, {-2, -2, 2}, {-2, 2, 2}, {2, 2, 2}, {2, -2, 2}, 1, 1, 0);
    test::add_quad(scene, {-.3, -.3, 1}, {-.3, .3, 1}, {.3, .3, 1}, {.3, -.3, 1}, 1, 1, 0);
    // The second hides a part of what the first hides.
    test::add_quad(scene, {-.2, -.2, 1.5}, {-.2, .2, 1.5}, {1, .2, 1.5}, {1, -.2, 1.5}, 1, 1, 0);
    const Rows rows(std::move(scene));
    const PointFactors row = rows.row(rows.at({0, 0, 0}, {0, 0, 1}));
    const double first = 4 * to_rectangle_above(.3, .3, 1);
    const double second = 2 * (to_rectangle_above(1, .2, 1.5) - to_rectangle_above(.45, .2, 1.5));
    CHECK(between(row, 1) == Approx(first).epsilon(1e-12));
    CHECK(between(row, 2) == Approx(second).epsilon(1e-12));
    CHECK(between(row, 0) ==
          Approx(4 * to_rectangle_above(2, 2, 2) - first - second).epsilon(1e-12));
    CHECK(row.standard_error == std::vector<double>{0, 0, 0});
}

TEST_CASE("Factors from points among blocks are those of plain rays") {
    const Rows rows(blocks());
    constexpr int rays = 200'000;
    Rng random(5);
    int compared = 0;
    for (int k = 0; k < 12; ++k) {
        const Vec3 place(8 * random.uniform(), 8 * random.uniform(), 2.6 + .3 * random.uniform());
        const Vec3 tilt(random.uniform() - .5, random.uniform() - .5, random.uniform() - .6);
        // Every third stands on the ground, in a lane.
        FactorPoint point =
            rows.at(k % 3 == 0 ? Vec3(.5, place.y, 0) : place, k % 3 == 0 ? Vec3(0, 0, 1) : tilt);
        if (k % 3 == 0)
            for (std::uint32_t f = 0; f < 36; ++f) // the ground's facet that holds it
                if (const Patch& patch = rows.model.mesh.patches()[f]; glm::all(glm::lessThan(
                        glm::abs(point.position - patch.centre), Vec3(.09, .09, 1e-9))))
                    point.facet = patch.facet;
        const PointFactors row = rows.row(point);
        auto truth = by_rays(rows, point, rays);
        const auto n = static_cast<std::uint32_t>(rows.row_of.size());
        std::map<std::uint32_t, OpenShare> found;
        for (std::size_t i = 0; i < row.column.size(); ++i)
            found[row.column[i]] = {row.factor[i], row.standard_error[i]};
        for (std::uint32_t open = 0; open < opens; ++open)
            found[n + open] = row.open[open];
        for (const auto& [column, share] : found) {
            const double p = share.factor;
            const double error = std::hypot(std::sqrt(p * (1 - p) / rays), share.standard_error);
            CHECK(std::abs(truth[column] - p) < 5 * error + 4.0 / rays);
            CHECK(share.standard_error < 1e-4);
            ++compared;
        }
        for (const auto& [column, share] : truth)
            if (share > 1e-4)
                CHECK(found[column].factor > 0);
        CHECK(row.sum() == Approx(1).margin(1e-12));
    }
    CHECK(compared > 200);
}

TEST_CASE("Where too much lies between, rays say what is seen within their errors") {
    Scene scene = test::bare_scene();
    test::add_quad(scene, {-2, -2, 2}, {-2, 2, 2}, {2, 2, 2}, {2, -2, 2}, 1, 1, 0);
    double hidden = 0;
    for (int i = -10; i < 10; ++i) // a grid of 400 plates that hides a part of the roof
        for (int k = -10; k < 10; ++k) {
            const double x = i * .1 + .02, y = k * .1 + .02, d = .06;
            test::add_quad(scene, {x, y, 1}, {x, y + d, 1}, {x + d, y + d, 1}, {x + d, y, 1}, 1, 1,
                           0);
            const auto corner = [](double a, double b) {
                return std::copysign(1., a * b) * to_rectangle_above(std::abs(a), std::abs(b), 1);
            };
            hidden += corner(x + d, y + d) - corner(x, y + d) - corner(x + d, y) + corner(x, y);
        }
    const Rows rows(std::move(scene));
    const double truth = 4 * to_rectangle_above(2, 2, 2) - hidden;
    double squares = 0;
    constexpr int seeds = 30;
    for (int seed = 1; seed <= seeds; ++seed) {
        const PointFactors row =
            rows.row(rows.at({0, 0, 0}, {0, 0, 1}), {.seed = static_cast<std::uint64_t>(seed)});
        REQUIRE(row.column.front() == 0);
        const double z = (row.factor[0] - truth) / row.standard_error[0];
        CHECK(std::abs(z) < 4);
        CHECK(row.standard_error[0] < .012 * truth);
        CHECK(row.open[0].standard_error >= row.standard_error[0]);
        CHECK(row.sum() == Approx(1).margin(1e-12));
        squares += z * z;
    }
    CHECK(squares / seeds < 1.5);
}

TEST_CASE("Rows of points have the same bytes for any number of threads") {
    const Rows rows(blocks());
    std::vector<FactorPoint> points;
    for (int k = 0; k < 20; ++k)
        points.push_back(rows.at({.4 * k, .5, .3}, {k - 9.5, 3, 4}));
    Monitor monitor;
    const auto with = [&](unsigned threads) {
        return point_factors(points, rows.model.mesh, rows.model.bvh, rows.row_of, {},
                             Workers(threads), monitor);
    };
    const auto one = with(1), three = with(3);
    for (std::size_t k = 0; k < points.size(); ++k) {
        CHECK(one[k].factor == three[k].factor);
        CHECK(one[k].column == three[k].column);
        CHECK(one[k].open[0].factor == three[k].open[0].factor);
    }
    monitor.interrupted.set_wished(true);
    CHECK_FALSE(with(1)[0].is_known);
}
