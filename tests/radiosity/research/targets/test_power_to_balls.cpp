// A target that rays go straight to: its light, against a form factor.
#include "support/catch.h"
#include "support/closed_forms.h"
#include "support/scenes.h"
#include "support/solve.h"
#include "support/targets.h"

#include <cmath>

using namespace hemilux;
using test::Model;

namespace {

constexpr double half = .03; ///< of the edge of the target

/// A black box with a lamp as its ceiling, and a small grey square just above the middle of its
/// floor.
Scene square_on_floor() {
    const Material black{"black", Vec3(0.0), Vec3(0.0)}, lamp{"lamp", Vec3(0.0), Vec3(1.0)},
        grey{"grey", Vec3(.5), Vec3(0.0)};
    Scene scene = test::box_room({0, 0, 0}, {1, 1, 1}, 1, {black, lamp, grey}, {0, 1, 0, 0, 0, 0});
    const double low = .5 - half, high = .5 + half, y = 1e-3;
    test::add_quad(scene, {low, y, low}, {low, y, high}, {high, y, high}, {high, y, low}, 1, 1, 2);
    return scene;
}

/// From the square to the ceiling: the mean over points of the square.
double factor_to_ceiling() {
    constexpr int n = 8;
    const double h = 1 - 1e-3;
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k) {
            const double x = .5 + half * ((2 * i + 1.0) / n - 1),
                         z = .5 + half * ((2 * k + 1.0) / n - 1);
            for (const double a : {x, 1 - x})
                for (const double b : {z, 1 - z})
                    sum += test::point_under_corner(a / h, b / h) / (n * n);
        }
    return sum;
}

} // namespace

TEST_CASE("Rays to balls carry the power that a small target is due") {
    const Model model(square_on_floor());
    const auto target = static_cast<std::uint32_t>(model.mesh.patches().size() - 1);
    std::vector<double> weight(target + 1, 0.0);
    weight[target] = 1;
    const double exact = .5 * factor_to_ceiling();
    for (const char* name : {"hemisphere", "stratified"}) {
        const SolveOptions options{.rays = 40'000, .threads = 1};
        const Solution s =
            test::solve_for(model, *find_method(name), weight, options, test::steps(8));
        CAPTURE(name, s.hits[target], s.rays_energy, s.standard_error[target].x);
        CHECK(double(s.hits[target]) > .05 * double(s.rays_energy)); // they were aimed
        CHECK(s.standard_error[target].x < .002 * exact);
        CHECK(s.radiosity[target].x == Approx(exact).epsilon(.008));
    }
}
