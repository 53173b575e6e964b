// How well an estimated error is known: parts of an error, and what follows from few of them.
#include "radiosity/paper/solution/error_spread.h"
#include "support/catch.h"
#include "support/paper_solve.h"
#include "support/scenes.h"

#include <optional>
#include <random>
#include <vector>

using namespace hemilux;

namespace {

/// Parts that are found, on average of many draws, where `parts` independent errors make up that of
/// each of four samples.
double mean_share_found(int parts) {
    constexpr std::size_t samples = 4;
    constexpr int draws = 400;
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    double inverse = 0;
    for (int draw = 0; draw < draws; ++draw) {
        std::vector<double> products(samples * samples, 0.0);
        for (int part = 0; part < parts; ++part) {
            double off[samples], mean = 0;
            for (double& each : off)
                mean += (each = normal(random)) / samples;
            for (std::size_t s = 0; s < samples; ++s)
                for (std::size_t t = 0; t < samples; ++t)
                    products[s * samples + t] += (off[s] - mean) * (off[t] - mean);
        }
        inverse += 1 / effective_freedom(products, samples) / draws;
    }
    return inverse;
}

} // namespace

TEST_CASE("The parts of an error are found from the products of few samples") {
    CHECK(mean_share_found(1) == Approx(1));
    CHECK(1 / mean_share_found(4) == Approx(4).epsilon(.25));
    CHECK(1 / mean_share_found(30) == Approx(30).epsilon(.25));
    CHECK(1 / mean_share_found(1000) > 500);
    const std::vector<double> nothing(16, 0.0);
    CHECK(effective_freedom(nothing, 4) == std::numeric_limits<double>::infinity());
}

TEST_CASE("An error of many parts is well known, one of few is not") {
    const ErrorSpread many{1e4, 3}, few{2, 3}, sure{std::numeric_limits<double>::infinity(), 3};
    CHECK(many.uncertainty() < .01);
    CHECK(few.uncertainty() > .25);
    CHECK(many.bound() < 1.05);
    CHECK(few.bound() > 2);
    CHECK(sure.bound() == 1);
    const test::PaperModel model(test::room_with_block());
    Solution nothing;
    nothing.steps = 1;
    CHECK(std::isnan(error_spread(model.mesh, nothing).bound()));
    for (const test::Page& page : test::pages_of_steps) {
        const Solution s = test::solve_page(model, page, {}, 3);
        const ErrorSpread spread = error_spread(model.mesh, s);
        CAPTURE(page.name, spread.freedom);
        CHECK(spread.freedom > 1);
        CHECK(spread.uncertainty() > 0);
        CHECK(spread.uncertainty() < .5);
    }
}

TEST_CASE("A step that happens to show many parts of an error does not undo what others showed") {
    CHECK(believed_freedom(std::nullopt, 40) == 40);
    CHECK(believed_freedom(3.0, 40) == 3);
    CHECK(believed_freedom(3.0, 2) == 2);
}

TEST_CASE("What all patches err by together counts more where few steps have shown it") {
    const test::PaperModel model(test::room_with_block());
    Solution s = test::solve_page(model, test::pages_of_steps[3], {}, 4);
    CHECK(s.level_freedom == 3);
    CHECK(s.variance_of_level < *s.variance);
    const auto error = [&](double share, double freedom) {
        s.variance_of_level = share * *s.variance;
        s.level_freedom = freedom;
        return estimated_error(model.mesh, s);
    };
    const double counted = error(.1, std::numeric_limits<double>::infinity());
    CHECK(counted == Approx(error(0, 3)).epsilon(.1));
    CHECK(error(.1, 15) > counted);
    CHECK(error(.1, 3) > 1.15 * counted); // F with 1 and 3 degrees of freedom: 17.4 at .975
    CHECK(error(1e-4, 3) == Approx(error(0, 3)).epsilon(1e-3));
}
