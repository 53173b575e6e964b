// Sky and ground by rays that rise or fall: closed forms, and errors that hold against rays in all
// directions.
#include "radiosity/engine/factors/rows/open_views.h"
#include "radiosity/engine/factors/rows/row_rays.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/solver.h"
#include "support/bare_scene.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <cmath>
#include <string>

using namespace hemilux;

namespace {

constexpr auto sky = static_cast<std::size_t>(Open::sky),
               ground = static_cast<std::size_t>(Open::ground);

/// A square of unit size whose normal is turned by an angle about x from straight up.
void add_tilted(Scene& scene, double angle, const Vec3& at) {
    const Vec3 up(0, std::cos(angle), std::sin(angle)), along(1, 0, 0);
    test::add_quad(scene, at, at + along, at + along + up, at + up, 1, 1, 0);
}

OpenViews views_of(const test::Model& model, const OpenViewOptions& options, unsigned threads = 1) {
    Monitor monitor;
    return find_open_views(model.mesh, model.bvh, options, Workers(threads), monitor);
}

} // namespace

TEST_CASE("A tilted patch alone sees as much of the sky as its normal says, exactly") {
    for (const double angle : {0.0, .3, 1.2, 1.5707963267948966, 2.2, 3.1}) {
        Scene scene = test::bare_scene();
        add_tilted(scene, angle, Vec3(0.0));
        const OpenViews views = views_of(test::Model(std::move(scene)), {});
        CHECK(views.open[0][sky].factor == Approx((1 + std::cos(angle)) / 2).margin(1e-12));
        CHECK(views.open[0][ground].factor == Approx((1 - std::cos(angle)) / 2).margin(1e-12));
    }
}

TEST_CASE("Errors of the sky and the ground hold for patches of all tilts") {
    Scene scene = test::bare_scene();
    for (int k = 0; k < 24; ++k)
        add_tilted(scene, .13 * k, Vec3(1.7 * (k % 5), 1.3 * (k / 5), .4 * ((7 * k) % 5)));
    const test::Model model(std::move(scene));
    const std::size_t patches = model.mesh.patches().size();
    double squares = 0, worst = 0;
    int count = 0;
    for (const std::uint64_t seed : {1, 2, 3}) {
        const OpenViews views = views_of(model, {.seed = seed});
        const FacingBacks backs(model.mesh);
        RowRays referee({model.mesh, model.bvh, backs, 99, 2});
        RowView truth;
        for (std::uint32_t i = 0; i < patches; ++i) {
            referee.trace(i, 1 << 16, truth);
            for (const std::size_t open : {sky, ground}) {
                const OpenShare &a = views.open[i][open], &b = truth.open[open];
                CHECK(a.standard_error <= .01 * std::max(a.factor, .01) * (1 + 1e-9));
                const double error = std::hypot(a.standard_error, b.standard_error);
                if (!(error > 0))
                    continue;
                const double z = (a.factor - b.factor) / error;
                worst = std::max(worst, std::abs(z));
                squares += z * z;
                ++count;
            }
        }
    }
    CHECK(count > 100);
    CHECK(std::sqrt(squares / count) < 1.2);
    CHECK(worst < 4.5);
}

TEST_CASE("The sky alone shows what is done, and how much of it") {
    Scene scene = test::bare_scene();
    for (int k = 0; k < 40; ++k)
        add_tilted(scene, .1, Vec3(1.1 * (k % 7), .9 * (k / 7), .3 * ((5 * k) % 7)));
    const test::Model model(std::move(scene));
    Monitor whole, interrupted;
    const OpenViews views =
        find_open_views(model.mesh, model.bvh, {.ground = false}, Workers(1), whole);
    CHECK(std::string(whole.phase) == "measuring the sky");
    CHECK(whole.step_share == 1);
    CHECK(whole.rays == views.rays);
    interrupted.interrupted.set_wished(true);
    CHECK(find_open_views(model.mesh, model.bvh, {}, Workers(1), interrupted).is_void);
    CHECK(std::string(interrupted.phase) == "measuring sky and ground");
}

TEST_CASE("The sky alone has the same bytes for any number of threads, and needs fewer rays") {
    Scene scene = test::bare_scene();
    for (int k = 0; k < 40; ++k)
        add_tilted(scene, .08 * k, Vec3(1.1 * (k % 7), .9 * (k / 7), .3 * ((5 * k) % 7)));
    const test::Model model(std::move(scene));
    const OpenViews one = views_of(model, {}, 1), three = views_of(model, {}, 3),
                    alone = views_of(model, {.ground = false});
    CHECK(alone.rays < one.rays);
    for (std::size_t i = 0; i < one.open.size(); ++i) {
        CHECK(one.open[i][sky].factor == three.open[i][sky].factor);
        CHECK(one.open[i][ground].standard_error == three.open[i][ground].standard_error);
        CHECK(alone.open[i][sky].factor == one.open[i][sky].factor);
    }
}
