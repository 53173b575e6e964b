// What the end of the time, or an interrupt, leaves of view factors: values with errors that hold.
#include "radiosity/engine/factors/rows/open_views.h"
#include "radiosity/engine/factors/rows/view_factors.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/solver.h"
#include "support/bare_scene.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <atomic>
#include <cmath>
#include <numeric>

using namespace hemilux;

namespace {

Scene few_blocks() {
    Scene scene = test::bare_scene();
    test::add_quad(scene, {0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}, 6, 6, 0);
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 2; ++k) {
            const Vec3 low(.8 + 2.5 * i, .7 + 3.6 * k, 0);
            test::add_block(scene, low, low + Vec3(1.3, 1.8, .7 + .6 * ((i + 2 * k) % 4)));
        }
    return scene;
}

struct Blocks {
    test::Model model{few_blocks()};
    std::vector<std::uint32_t> row_of = [this] {
        std::vector<std::uint32_t> rows(model.mesh.patches().size());
        std::iota(rows.begin(), rows.end(), 0u);
        return rows;
    }();

    [[nodiscard]] ViewFactors factors(Monitor& monitor, const ExchangeOptions& options = {},
                                      unsigned threads = 1) const {
        return view_factors(model.mesh, model.bvh, row_of, row_of.size(), options, Workers(threads),
                            monitor);
    }
};

/// Compares factors with exact ones in units of the errors of both.
void check_errors(const ViewFactors& found, const ViewFactors& exact) {
    double squares = 0, count = 0;
    for (std::uint32_t i = 0; i < found.rows(); ++i) {
        CHECK(found.row_sum(i) == Approx(1).margin(1e-12));
        for (std::size_t k = found.row_begin[i]; k < found.row_begin[i + 1]; ++k) {
            const OpenShare truth = exact.between(i, found.column[k]);
            const double error = std::hypot(found.standard_error[k], truth.standard_error);
            const double z = (found.factor[k] - truth.factor) / std::max(error, 1e-8);
            CHECK(std::abs(z) < 5);
            squares += z * z;
            ++count;
        }
        for (std::size_t k = 0; k < opens; ++k)
            CHECK(
                std::abs(found.open[i][k].factor - exact.open[i][k].factor) <
                4.5 * std::hypot(found.open[i][k].standard_error, exact.open[i][k].standard_error) +
                    1e-8);
    }
    CHECK(count > 200);
    CHECK(std::sqrt(squares / count) < 1.25);
}

} // namespace

TEST_CASE("Without time rays alone say what they know, the same for any number of threads") {
    const Blocks blocks;
    Monitor free, ended;
    const ViewFactors exact = blocks.factors(free, {.tolerance = relative_above(.002, 1e-3)}, 2);
    CHECK(exact.work.rows_left == 0);
    ended.interrupted.set_out_of_time(true);
    const ViewFactors found = blocks.factors(ended);
    CHECK(found.work.rows_left == found.rows());
    CHECK(found.work.line_pairs == 0);
    for (const double error : found.standard_error)
        CHECK(error > 0);
    check_errors(found, exact);
    const ViewFactors again = blocks.factors(ended, {}, 3);
    CHECK(again.factor == found.factor);
    CHECK(again.standard_error == found.standard_error);
}

TEST_CASE("A run that is interrupted among pairs keeps those that are done, and passes before") {
    const Blocks blocks;
    Monitor free;
    const ViewFactors exact = blocks.factors(free, {.tolerance = relative_above(.002, 1e-3)}, 2);
    // Memory is asked for as rows and then pairs are found, so counting calls stops it in the
    // middle.
    const auto rows = static_cast<int>(blocks.row_of.size());
    const auto cut_after = [&](int calls, std::vector<double> before) {
        Monitor monitor;
        ExchangeOptions options;
        options.before = std::move(before);
        options.ask = [&monitor, calls, count = 0](double) mutable {
            if (++count == calls)
                monitor.interrupted.set_wished(true);
        };
        return blocks.factors(monitor, options);
    };
    const ViewFactors half = cut_after(rows + rows / 4, {});
    CHECK((half.work.rows_left > 0 && half.work.rows_left < half.rows()));
    CHECK(half.work.exact_pairs > 0);
    check_errors(half, exact);
    const ViewFactors with_pass = cut_after(2 * rows + rows / 4, {4});
    CHECK((with_pass.work.rows_left > 0 && with_pass.work.rows_left < half.rows()));
    check_errors(with_pass, exact);
    CHECK(errors_above(with_pass, .01).rms < .6 * errors_above(half, .01).rms);
    CHECK(cut_after(rows / 2, {}).rows() == 0); // not even the rays are known
}

TEST_CASE("Sky and ground alone are known as soon as the first rays are") {
    const Blocks blocks;
    const auto views = [&](Monitor& monitor) {
        return find_open_views(blocks.model.mesh, blocks.model.bvh, {.error = .003}, Workers(1),
                               monitor);
    };
    Monitor free, ended, interrupted;
    const OpenViews exact = views(free);
    ended.interrupted.set_out_of_time(true);
    const OpenViews first = views(ended);
    CHECK((!first.is_void && first.rows_left > 0 && exact.rows_left == 0));
    CHECK(first.rays == 256 * blocks.row_of.size());
    double squares = 0;
    for (std::size_t i = 0; i < blocks.row_of.size(); ++i) {
        const OpenShare &a = first.open[i][0], &b = exact.open[i][0];
        const double error = std::hypot(a.standard_error, b.standard_error);
        if (error > 0)
            squares += (a.factor - b.factor) * (a.factor - b.factor) / (error * error);
    }
    CHECK(std::sqrt(squares / double(blocks.row_of.size())) < 1.25);
    interrupted.interrupted.set_wished(true);
    CHECK(views(interrupted).is_void);
}
